"""From a job to its results store, or to the problem that says why there is none to read.

Stores can be read as they grow: what a job has committed, and nothing else.
"""

from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.dependencies import CatalogueDependency, JobOfThePath, SettingsDependency
from jointplay.service.jobs.results_of_kinds import insist
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue import Catalogue, Job
from jointplay.storage.results import NotAStore, ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies import StudyReader

_OPEN_STORES = 64  # a reader of a sealed store holds metadata only, some 100 kB
_OPEN_STUDIES = 8  # this one also holds what has one number a point: 20 MB of the largest study


def open_store(job: Job, settings: Settings, catalogue: Catalogue) -> ResultReader:
    """Return the reader of a simulation's results as they are now.

    Raises
    ------
    RequestRefused
        409 before the job has begun, 404 if it ended before anything was computed.
    """
    if job.attempt > 0:
        try:
            return _sealed(settings.result_folder(job.id, job.attempt))
        except NotAStore:
            pass
        folder, samples = committed_so_far(job, catalogue, settings)
        try:
            return ResultReader(folder, samples)
        except NotAStore:
            pass
    if job.state.terminal:
        raise _nothing(job)
    raise not_ready(job, "its results can be read once it has begun")


def committed_so_far(job: Job, catalogue: Catalogue, settings: Settings) -> tuple[Path, int]:
    """Return the folder of a growing store, and how many samples are committed there.

    Until an attempt has a restart point of its own, what counts is that of the one before.
    """
    (block, *_) = catalogue.blocks(job.id)
    attempt = job.attempt
    if block.checkpoint is not None:
        attempt = int(block.checkpoint.rpartition("-a")[2])
    return settings.result_folder(job.id, attempt), block.watermark


def open_study(job: Job, settings: Settings) -> StudyReader:
    """Return the reader of a study as it is now.

    Raises
    ------
    RequestRefused
        409 before its first block has begun, 404 if it ended before that.
    """
    folder = settings.study_folder(job.id)
    try:
        return _sealed_study(folder)
    except NotAStore:
        pass
    try:
        return StudyReader(folder)
    except NotAStore:
        if job.state.terminal:
            raise _nothing(job) from None
        raise not_ready(job, "its points can be read once the first ones are computed") from None


def not_ready(job: Job, when: str) -> RequestRefused:
    """Return the refusal of what a running job has not yet; `when` says when it will."""
    return RequestRefused(
        kinds.RESULTS_NOT_READY,
        f"Job {job.id} is {job.state} at {job.progress_fraction:.0%}; {when}.",
        headers={"Retry-After": "1"},
    )


def _nothing(job: Job) -> RequestRefused:
    why = f" {job.error.detail}" if job.error else ""
    return RequestRefused(
        kinds.NO_RESULTS, f"Job {job.id} is {job.state} and computed nothing.{why}"
    )


@lru_cache(maxsize=_OPEN_STORES)
def _sealed(folder: Path) -> ResultReader:
    """Return a reader to be shared: a finished job's store never changes again."""
    reader = ResultReader(folder)
    if not reader.sealed:
        raise NotAStore(f"{folder} was never finished")
    return reader


@lru_cache(maxsize=_OPEN_STUDIES)
def _sealed_study(folder: Path) -> StudyReader:
    reader = StudyReader(folder)
    if not reader.sealed:
        raise NotAStore(f"{folder} is being filled")
    return reader


def _store_of_the_path(
    request: Request,
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
) -> ResultReader:
    insist(job, request.url.path.rpartition("/")[2])
    return open_store(job, settings, catalogue)


StoreOfThePath = Annotated[ResultReader, Depends(_store_of_the_path)]
