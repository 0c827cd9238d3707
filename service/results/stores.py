"""From a job to its results store, or to the problem that says why there is none to read.

A study's store is read as it grows; a simulation's when it is finished.
"""

from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import Depends, Request

from service.dependencies import JobOfThePath, SettingsDependency
from service.jobs.results_of_kinds import insist
from service.problems import RequestRefused, kinds
from storage.catalogue import Job
from storage.results import NotAStore, ResultReader
from storage.settings import Settings
from storage.studies import StudyReader

_OPEN_STORES = 64  # a reader of a sealed store holds metadata only, some 100 kB
_OPEN_STUDIES = 8  # this one also holds what has one number a point: 20 MB of the largest study


def open_store(job: Job, settings: Settings) -> ResultReader:
    """Return the reader of a finished simulation's results; what ended early keeps its own.

    Raises
    ------
    RequestRefused
        409 while the job is not finished, 404 if it ended before anything was computed.
    """
    if not job.state.terminal:
        raise _not_ready(job, "its results can be read when it is finished")
    if job.attempt > 0:
        try:
            return _sealed(settings.result_folder(job.id, job.attempt))
        except NotAStore:
            pass
    raise _nothing(job)


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
        raise _not_ready(job, "its points can be read once the first ones are computed") from None


def _not_ready(job: Job, when: str) -> RequestRefused:
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
    request: Request, job: JobOfThePath, settings: SettingsDependency
) -> ResultReader:
    insist(job, request.url.path.rpartition("/")[2])
    return open_store(job, settings)


StoreOfThePath = Annotated[ResultReader, Depends(_store_of_the_path)]
