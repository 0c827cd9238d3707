"""From a job to its results store, or to the problem that says why there is none to read."""

from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import Depends

from service.dependencies import JobOfThePath, SettingsDependency
from service.problems import RequestRefused, kinds
from storage.catalogue import Job
from storage.results import NotAStore, ResultReader
from storage.settings import Settings

_OPEN_STORES = 64  # a reader of a sealed store holds metadata only, some 100 kB


def open_store(job: Job, settings: Settings) -> ResultReader:
    """Return the reader of a finished job's results; failed and cancelled jobs keep theirs.

    Raises
    ------
    RequestRefused
        409 while the job is not finished, 404 if it ended before anything was computed.
    """
    if not job.state.terminal:
        raise RequestRefused(
            kinds.RESULTS_NOT_READY,
            f"Job {job.id} is {job.state} at {job.progress_fraction:.0%}; its results can be read "
            "when it is finished.",
            headers={"Retry-After": "1"},
        )
    if job.attempt > 0:
        try:
            return _sealed(settings.result_folder(job.id, job.attempt))
        except NotAStore:
            pass
    why = f" {job.error.detail}" if job.error else ""
    raise RequestRefused(
        kinds.NO_RESULTS, f"Job {job.id} is {job.state} and computed nothing.{why}"
    )


@lru_cache(maxsize=_OPEN_STORES)
def _sealed(folder: Path) -> ResultReader:
    """Return a reader to be shared: a finished job's store never changes again."""
    reader = ResultReader(folder)
    if not reader.sealed:
        raise NotAStore(f"{folder} was never finished")
    return reader


def _store_of_the_path(job: JobOfThePath, settings: SettingsDependency) -> ResultReader:
    return open_store(job, settings)


StoreOfThePath = Annotated[ResultReader, Depends(_store_of_the_path)]
