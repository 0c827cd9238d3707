"""From a job and a key to bytes: of a finished store as stored, of a growing one as committed."""

from service.jobs.results_of_kinds import is_study
from service.zarr.content import Content
from storage.catalogue import Catalogue, Job
from storage.results.layout import MANIFEST
from storage.settings import Settings


def content_of(job: Job, key: str, catalogue: Catalogue, settings: Settings) -> Content | None:
    """Return what a key of the job's store holds, or None."""
    study = is_study(job)
    folder = settings.study_folder(job.id) if study else settings.result_folder(job.id, job.attempt)
    if (folder / MANIFEST).exists():
        return Content.of_file(folder, key)
    return None
