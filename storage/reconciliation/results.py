"""Sealed results against their manifests, and against the jobs of the catalogue."""

import errno
import json
from collections.abc import Iterator
from functools import partial

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import NOT_REPRODUCED, BlockState, Job, JobState
from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.identity import growing_study, require_results_of
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Packed
from jointplay.storage.reconciliation.extent import Extent, several_at_once
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.results import manifest
from jointplay.storage.results.metadata import FILE, Document
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings

WHERE = "results"
_MENDED = ("marked as damaged", "no longer marked as damaged")
_ANEW = "jointplay show {0} --job > job.json; jointplay submit job.json"


def damage(
    settings: Settings, catalogue: Catalogue, extent: Extent | None = None
) -> Iterator[Finding]:
    """Compare the results of jobs that have ended with what was stored.

    All are looked for in a list of what there is; of those that `extent` chooses, of those that are
    marked as damaged or not in that list, every byte is read.
    """
    extent = extent or Extent()
    listed = {job_in(key) for key in settings.object_store.list("")}
    ended, besides = [], []
    for job in catalogue.every_job():
        if job.state.terminal:
            ended.append(job.id)
            lacks = job.state is JobState.succeeded and job.id not in listed
            if lacks or job.damaged:
                besides.append(job.id)
    chosen = extent.chosen(ended, besides)
    extent.counted.read, extent.counted.there = len(chosen), len(ended)

    def compared(job_id: str) -> tuple[Job, str | None] | None:
        try:
            job = catalogue.get(job_id)
            found = damage_of(settings, job) or _unsealed_damage(settings, catalogue, job)
        except JobNotFound:  # its row has gone meanwhile
            return None
        mismatched = job.damaged == NOT_REPRODUCED  # which no look at bytes can tell
        return job, NOT_REPRODUCED if found is None and mismatched else found

    for done, (_, one) in enumerate(several_at_once(compared, chosen)):
        extent.report(done / len(chosen), f"read {done} of {len(chosen)} results")
        if one is None:
            continue
        job, found = one
        known = job.damaged in (found, NOT_REPRODUCED)
        mended = None if known else _MENDED[found is None]
        if (found is None and mended is None) or _has_gone(catalogue, job):
            continue
        yield Finding(
            WHERE,
            (f"job {job.id}",),
            found or "is marked as damaged, and its results are whole",
            mended,
            _ANEW.format(job.id) if found else None,
            partial(catalogue.mark_damaged, job.id, found) if mended else None,
        )


def _has_gone(catalogue: Catalogue, job: Job) -> bool:
    """Whether a job was removed while its results were read."""
    try:
        return catalogue.expired(catalogue.get(job.id))
    except JobNotFound:
        return True


def job_in(key: str) -> str:
    """Return the id of the job that an object's name begins with."""
    return key.rpartition("/")[2].partition("-")[0]


def damage_of(settings: Settings, job: Job) -> str | None:
    """Return what is wrong with the results of a job that has ended; none if they are whole."""
    try:
        sealed = sealed_results(settings, job)
        if sealed is not None:
            require_results_of(job, verified(sealed), str(sealed))
        elif job.state is JobState.succeeded:
            raise LostObject(f"{settings.results_prefix(job.id)}*.zarr.zip is gone")
    except (NotAStore, CorruptStore) as error:
        return str(error)
    except OSError as error:
        if error.errno != errno.EIO:  # such as permissions, which are the reader's
            raise
        return f"{settings.results_prefix(job.id)}*.zarr.zip cannot be read: {error.strerror}"
    return None


def _unsealed_damage(settings: Settings, catalogue: Catalogue, job: Job) -> str | None:
    """Return what is wrong with the parts of a job that ended without sealed results."""
    if job.state is JobState.succeeded or sealed_results(settings, job) is not None:
        return None
    blocks = catalogue.blocks(job.id)
    if not any(block.watermark or block.state is BlockState.done for block in blocks):
        return None  # nothing was computed
    try:
        if any(block.count == 0 for block in blocks):  # the one that seals a study
            study = growing_study(settings, catalogue, job.id)
            require_results_of(job, study.attributes, str(study.files))
            settings.running_study(job.id).verify()
        else:
            (block,) = blocks
            attempt = int((block.checkpoint or "").rpartition("-a")[2] or job.attempt)
            files = settings.running_run(job.id, attempt)
            run = ResultReader(files, block.watermark)
            require_results_of(job, run.attributes, str(files))
            files.verify()
    except (NotAStore, CorruptStore) as error:
        return str(error)
    return None


def sealed_results(settings: Settings, job: Job) -> StoredObject | None:
    """Return what holds the results of a job, whatever its kind; none: they are not sealed."""
    candidates = settings.sealed_study(job.id), settings.sealed_run(job.id, job.attempt)
    return next((one for one in candidates if one.exists()), None)


def verified(sealed: StoredObject) -> Document:
    """Compare all of a store with its manifest, and return the attributes of its root.

    Raises
    ------
    NotAStore, CorruptStore
        It is not what was sealed.
    """
    files = Packed(sealed)
    manifest.verify(files)
    attributes: Document = json.loads(files.read(FILE))["attributes"]
    return attributes
