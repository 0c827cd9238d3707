"""From a job to its results store, or to the problem that says why there is none to read.

Stores can be read as they grow: what a job has committed, and nothing else.
"""

from functools import lru_cache
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.dependencies import CatalogueDependency, JobOfThePath, SettingsDependency
from jointplay.service.jobs.results_of_kinds import insist, is_study
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue import Catalogue, Job
from jointplay.storage.packed import Packed
from jointplay.storage.places import StoredObject
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
        sealed = sealed_of(job, settings)
        for _ in range(2):  # it may be sealed between the two looks
            try:
                return _sealed(sealed)
            except NotAStore:
                pass
            attempt, samples = committed_so_far(job, catalogue)
            try:
                growing = ResultReader(settings.running_run(job.id, attempt), samples)
            except NotAStore:
                continue
            if not sealed.exists():
                return growing
    if job.state.terminal:
        raise _nothing(job)
    raise not_ready(job, "its results can be read once it has begun")


def committed_so_far(job: Job, catalogue: Catalogue) -> tuple[int, int]:
    """Return the attempt whose growing store counts, and how many samples are committed there.

    Until an attempt has a restart point of its own, what counts is that of the one before.
    """
    (block, *_) = catalogue.blocks(job.id)
    attempt = job.attempt
    if block.checkpoint is not None:
        attempt = int(block.checkpoint.rpartition("-a")[2])
    return attempt, block.watermark


def sealed_of(job: Job, settings: Settings) -> StoredObject:
    """Return where the sealed results of a job are, or will be."""
    if is_study(job):
        return settings.sealed_study(job.id)
    return settings.sealed_run(job.id, job.attempt)


@lru_cache(maxsize=_OPEN_STORES)
def packed(source: StoredObject) -> Packed:
    """Return the files of a sealed store, which never change again; NotAStore if there is none."""
    return Packed(source)


def open_study(job: Job, settings: Settings) -> StudyReader:
    """Return the reader of a study as it is now.

    Raises
    ------
    RequestRefused
        409 before its first block has begun, 404 if it ended before that.
    """
    sealed = sealed_of(job, settings)
    for _ in range(2):  # it may be sealed between the two looks
        try:
            return _sealed_study(sealed)
        except NotAStore:
            pass
        try:
            return StudyReader(settings.running_study(job.id))
        except NotAStore:
            pass
    if job.state.terminal:
        raise _nothing(job)
    raise not_ready(job, "its points can be read once the first ones are computed")


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
def _sealed(source: StoredObject) -> ResultReader:
    """Return a reader to be shared."""
    return ResultReader(packed(source))


@lru_cache(maxsize=_OPEN_STUDIES)
def _sealed_study(source: StoredObject) -> StudyReader:
    return StudyReader(packed(source))


def _store_of_the_path(
    request: Request,
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
) -> ResultReader:
    insist(job, request.url.path.rpartition("/")[2])
    return open_store(job, settings, catalogue)


StoreOfThePath = Annotated[ResultReader, Depends(_store_of_the_path)]
