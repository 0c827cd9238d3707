"""From a job to its results store, or to the problem that says why there is none to read.

Stores can be read as they grow: what a job has committed, and nothing else.
"""

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Annotated, Any, TypeVar

from fastapi import Depends, Request

from jointplay.records.kinds_with import kinds_with
from jointplay.service.access import CallerDependency
from jointplay.service.dependencies import (
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
    visible_job,
)
from jointplay.service.memory import let_go_when_unused
from jointplay.service.problems import RequestRefused, kinds
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.identity import growing_study, require_results_of
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Packed
from jointplay.storage.packed.running import DOCUMENTS
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader

_OPEN_STORES = 16  # a reader of a sealed store holds metadata only: 0.9 MB of a hundred channels
_OPEN_STUDIES = 8  # this one also holds what has one number a point: 20 MB of the largest study
Reader = TypeVar("Reader", ResultReader, StudyReader)


class ResultsOfJob:
    """Results of a job, as they are now."""

    def __init__(self, job: Job, settings: Settings, catalogue: Catalogue) -> None:
        if job.kind not in KINDS:
            sentence = f"Job {job.id} is of kind {job.kind}, which this version does not know."
            raise RequestRefused(kinds.WRONG_KIND, sentence)
        self.job, self.settings, self.catalogue = job, settings, catalogue
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
            others = kinds_with({name: kind.results for name, kind in KINDS.items()}, result)
            raise RequestRefused(
                kinds.WRONG_KIND,
                f"Job {self.job.id} is of kind {self.job.kind} and has no {result}{others}. "
                f"It has {addresses}.",
            )

    def committed(self) -> tuple[int, int]:
        """Return the attempt whose growing run counts, and how many samples it has committed.

        Until an attempt has a restart point of its own, what counts is that of the one before.
        """
        (block, *_) = self.catalogue.blocks(self.job.id)
        if block.checkpoint is None:
            return self.job.attempt, block.watermark
        return int(block.checkpoint.rpartition("-a")[2]), block.watermark

    def require_own(self, attributes: Mapping[str, Any] | None = None) -> None:
        """Raise `CorruptStore` if the documents of the growing results are another job's.

        They are read unless their attributes are given.
        """
        if attributes is None:
            growing = (
                self.settings.running_study(self.job.id)
                if self.is_study
                else self.settings.running_run(self.job.id, self.committed()[0])
            )
            attributes = growing.attributes
        require_results_of(self.job, attributes, f"{DOCUMENTS} of the growing results")

    def whole(self) -> ResultReader | StudyReader | None:
        """Return the reader of the sealed results, which are the job's; None: there are none yet.

        Raises
        ------
        CorruptStore
            They are damaged, or another job's.
        """
        version = self.sealed.version()
        if version is None and self._must_be_sealed():
            raise LostObject(f"{self.sealed} is gone")
        if version is None:
            return None
        try:
            reader = (_sealed_study if self.is_study else _sealed_run)(self.sealed, version)
        except NotAStore as error:
            if not self.sealed.exists():
                return None
            raise CorruptStore(f"{self.sealed} holds something else: {error}") from error
        require_results_of(self.job, reader.attributes, str(self.sealed))
        return reader

    def run(self) -> ResultReader:
        """Return the reader of a simulation's results.

        Raises
        ------
        RequestRefused
            409 before the job has begun, 404 if it ended before anything was computed.
        CorruptStore
            Files are not what was stored.
        """

        def growing() -> ResultReader:
            attempt, samples = self.committed()
            return ResultReader(self.settings.running_run(self.job.id, attempt), samples)

        return self._open(ResultReader, growing, "its results can be read once it has begun")

    def study(self) -> StudyReader:
        """Return the reader of a study; it is refused as a run is."""
        when = "its points can be read once the first ones are computed"
        return self._open(
            StudyReader, lambda: growing_study(self.settings, self.catalogue, self.job.id), when
        )

    def not_ready(self, when: str) -> RequestRefused:
        """Return the refusal of what a running job has not yet; `when` says when it will."""
        return RequestRefused(
            kinds.RESULTS_NOT_READY,
            f"Job {self.job.id} is {self.job.state} at {self.job.progress_fraction:.0%}; {when}.",
            headers={"Retry-After": "1"},
        )

    def require_computed(self) -> None:
        """Raise `CorruptStore` if the job has computed something, of which there is nothing."""
        job = self.job
        if job.state.terminal and job.progress_fraction:
            raise LostObject(f"{self.sealed} is gone")
        # a calibration has restart points long before its point has ended
        if any(block.watermark or block.checkpoint for block in self.catalogue.blocks(job.id)):
            raise LostObject(f"{DOCUMENTS} of the growing results is gone")

    def _must_be_sealed(self) -> bool:
        """Whether the job ended in a way that follows sealing: it succeeded, or its run failed."""
        error = self.job.error
        failed = error is not None and error.error_class in ("solver", "limit")
        return self.job.state is JobState.succeeded or (failed and not self.is_study)

    def _open(self, wanted: type[Reader], growing: Callable[[], Reader], when: str) -> Reader:
        for _ in range(2):  # it may be sealed between the two looks
            whole = self.whole()
            if isinstance(whole, wanted):
                return whole
            try:
                reader = growing()
            except NotAStore:
                continue
            except CorruptStore:
                if self.sealed.exists():
                    continue
                self.require_own()
                raise
            if not self.sealed.exists():
                self.require_own(reader.attributes)
                return reader
        self.require_computed()
        if not self.job.state.terminal:
            raise self.not_ready(when)
        why = f" {self.job.error.detail}" if self.job.error else ""
        sentence = f"Job {self.job.id} is {self.job.state} and computed nothing.{why}"
        raise RequestRefused(kinds.NO_RESULTS, sentence)


@let_go_when_unused
@lru_cache(maxsize=_OPEN_STORES)
def _sealed_run(source: StoredObject, version: str) -> ResultReader:
    """Return a reader to be shared, of one version of an object: another is checked anew."""
    return ResultReader(Packed(source))


@let_go_when_unused
@lru_cache(maxsize=_OPEN_STUDIES)
def _sealed_study(source: StoredObject, version: str) -> StudyReader:
    return StudyReader(Packed(source))


async def _results_of_the_path(
    job: JobOfThePath, settings: SettingsDependency, catalogue: CatalogueDependency
) -> ResultsOfJob:
    return ResultsOfJob(job, settings, catalogue)


def _results_of_a_parameter(
    catalogue: CatalogueDependency, caller: CallerDependency, settings: SettingsDependency
) -> Callable[[str, str], ResultsOfJob]:
    """Return what gives the results of a job by its id, and the name of the parameter with it."""

    def found(job_id: str, parameter: str) -> ResultsOfJob:
        job = visible_job(catalogue, caller, job_id, parameter)
        return ResultsOfJob(job, settings, catalogue)

    return found


ResultsOfAParameter = Annotated[
    Callable[[str, str], ResultsOfJob], Depends(_results_of_a_parameter)
]
ResultsOfThePath = Annotated[ResultsOfJob, Depends(_results_of_the_path)]


def _reader_of_the_path(request: Request, results: ResultsOfThePath) -> ResultReader:
    results.insist(request.url.path.rpartition("/")[2])
    return results.run()


def _study_of_the_path(request: Request, results: ResultsOfThePath) -> StudyReader:
    results.insist(request.url.path.rpartition("/")[2])
    return results.study()


ReaderOfThePath = Annotated[ResultReader, Depends(_reader_of_the_path)]
StudyOfThePath = Annotated[StudyReader, Depends(_study_of_the_path)]
