"""From a job to its results store, or to the problem that says why there is none to read.

Stores can be read as they grow: what a job has committed, and nothing else.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Annotated, TypeVar

from fastapi import Depends, Request

from jointplay.service.dependencies import CatalogueDependency, JobOfThePath, SettingsDependency
from jointplay.service.problems import RequestRefused, kinds
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job
from jointplay.storage.errors import NotAStore
from jointplay.storage.packed import Packed
from jointplay.storage.places import StoredObject
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader

_OPEN_STORES = 64  # a reader of a sealed store holds metadata only, some 100 kB
_OPEN_STUDIES = 8  # this one also holds what has one number a point: 20 MB of the largest study
Reader = TypeVar("Reader", ResultReader, StudyReader)


class ResultsOfJob:
    """What a job has computed, as it is now."""

    def __init__(self, job: Job, settings: Settings, catalogue: Catalogue) -> None:
        self.job, self.settings = job, settings
        self._catalogue = catalogue
        self._names = KINDS[job.kind].results
        self.is_study = "history" not in self._names
        """It has points, and not one history."""
        self.sealed = (
            settings.sealed_study(job.id)
            if self.is_study
            else settings.sealed_run(job.id, job.attempt)
        )
        """Where the sealed results are, or will be."""

    def insist(self, result: str) -> None:
        """Refuse with 404 what a job of this kind does not have."""
        if result not in self._names:
            addresses = ", ".join(f"/v1/jobs/{self.job.id}/{name}" for name in self._names)
            raise RequestRefused(
                kinds.WRONG_KIND,
                f"Job {self.job.id} is of kind {self.job.kind} and has no {result}; "
                f"it has {addresses}.",
            )

    def committed(self) -> tuple[int, int]:
        """Return the attempt whose growing run counts, and how many samples it has committed.

        Until an attempt has a restart point of its own, what counts is that of the one before.
        """
        (block, *_) = self._catalogue.blocks(self.job.id)
        if block.checkpoint is None:
            return self.job.attempt, block.watermark
        return int(block.checkpoint.rpartition("-a")[2]), block.watermark

    def run(self) -> ResultReader:
        """Return the reader of a simulation's results.

        Raises
        ------
        RequestRefused
            409 before the job has begun, 404 if it ended before anything was computed.
        """

        def growing() -> ResultReader:
            attempt, samples = self.committed()
            return ResultReader(self.settings.running_run(self.job.id, attempt), samples)

        return self._open(_sealed_run, growing, "its results can be read once it has begun")

    def study(self) -> StudyReader:
        """Return the reader of a study; it is refused as a run is."""
        running = self.settings.running_study(self.job.id)
        when = "its points can be read once the first ones are computed"
        return self._open(_sealed_study, lambda: StudyReader(running), when)

    def not_ready(self, when: str) -> RequestRefused:
        """Return the refusal of what a running job has not yet; `when` says when it will."""
        return RequestRefused(
            kinds.RESULTS_NOT_READY,
            f"Job {self.job.id} is {self.job.state} at {self.job.progress_fraction:.0%}; {when}.",
            headers={"Retry-After": "1"},
        )

    def _open(
        self, sealed: Callable[[StoredObject], Reader], growing: Callable[[], Reader], when: str
    ) -> Reader:
        for _ in range(2):  # it may be sealed between the two looks
            try:
                return sealed(self.sealed)
            except NotAStore:
                pass
            try:
                reader = growing()
            except NotAStore:
                continue
            if not self.sealed.exists():
                return reader
        if not self.job.state.terminal:
            raise self.not_ready(when)
        why = f" {self.job.error.detail}" if self.job.error else ""
        sentence = f"Job {self.job.id} is {self.job.state} and computed nothing.{why}"
        raise RequestRefused(kinds.NO_RESULTS, sentence)


@lru_cache(maxsize=_OPEN_STORES)
def packed(source: StoredObject) -> Packed:
    """Return the files of a sealed store, which never change again; NotAStore if there is none."""
    return Packed(source)


@lru_cache(maxsize=_OPEN_STORES)
def _sealed_run(source: StoredObject) -> ResultReader:
    """Return a reader to be shared."""
    return ResultReader(packed(source))


@lru_cache(maxsize=_OPEN_STUDIES)
def _sealed_study(source: StoredObject) -> StudyReader:
    return StudyReader(packed(source))


async def _results_of_the_path(
    job: JobOfThePath, settings: SettingsDependency, catalogue: CatalogueDependency
) -> ResultsOfJob:
    return ResultsOfJob(job, settings, catalogue)


ResultsOfThePath = Annotated[ResultsOfJob, Depends(_results_of_the_path)]


def _run_of_the_path(request: Request, results: ResultsOfThePath) -> ResultReader:
    results.insist(request.url.path.rpartition("/")[2])
    return results.run()


def _study_of_the_path(request: Request, results: ResultsOfThePath) -> StudyReader:
    results.insist(request.url.path.rpartition("/")[2])
    return results.study()


RunOfThePath = Annotated[ResultReader, Depends(_run_of_the_path)]
StudyOfThePath = Annotated[StudyReader, Depends(_study_of_the_path)]
