"""Jobs of every kind with results to be damaged, sealed and running, each beside another like it.

The other's files have the same names: each can be exchanged for its like.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from jointplay.records.impact import IMPACT
from jointplay.records.job import JobError
from jointplay.records.run import CertificateRecord, LabelledArray
from jointplay.records.run_rows import RunRows
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, Claim
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.results.layout import Partition, ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.settings import Settings
from jointplay.worker.execute import Answer, Progress
from jointplay.worker.study_block import run_block
from tests.solver.calibration.calibrations import bounce
from tests.worker_by_hand import ACCURACY_STUDY, BIFURCATION, SWEEP, Worker

OTHER: Final = {"scene": {"preset": "seven-bar-press", "parameters": {"restitution": 0.8}}}
"""Makes a job of the same shape and another document."""
RUN: Final = {"channels": ["slider7.*", "A.*"]}
SMALL: Final = Partition(chunk_rows=64, shard_chunks=4, buffer_bytes=2**24)  # 256 samples a file
EDGES: Final = 5
INSTANTS: Final = np.linspace(0.0, 2.0, 5)  # s


@dataclass(frozen=True)
class File:
    """A file of a store by its name there; `like` is that of another job."""

    name: str
    stored: StoredObject
    like: StoredObject

    @property
    def folder(self) -> str:
        """Folder of the store that it is in."""
        return self.name.rpartition("/")[0]


@dataclass(frozen=True)
class Subject:
    """A job and the files of its store; a running one has a folder of them."""

    job: str
    files: list[File]
    filled: RunningFiles | None

    @property
    def running(self) -> bool:
        """The store is being filled."""
        return self.filled is not None


class Subjects:
    """Makes them, one a kind of store.

    Parameters
    ----------
    settings
        Of the service. Jobs are computed in its data folder, from where those that run are sent if
        they are read elsewhere.
    """

    def __init__(self, worker: Worker, catalogue: Catalogue, settings: Settings) -> None:
        self._worker = worker
        self._catalogue = catalogue
        self._reads = settings
        self._settings = computing(settings)

    def made(self, kind: str) -> Subject:
        """Make a subject of a kind in `KINDS`."""
        make, place = KINDS[kind]
        job, other = make(self), make(self, **OTHER)
        found, like = place(self._reads, job), place(self._reads, other)
        if isinstance(found, StoredObject):
            assert isinstance(like, StoredObject)
            return Subject(job, [File(found.key.rpartition("/")[2], found, like)], None)
        if self._reads.sends:
            self._send(job)
            self._send(other)
        files = [File(name, found.object(name), like.object(name)) for name in found.names()]
        return Subject(job, files, found)

    def _send(self, job: str) -> None:
        """Put the files of a running job where the service reads them."""
        here, there = self._settings.running_files(job), self._reads.running_files(job)
        for name in here.names():
            there.put(name, [here.read(name)])

    def run(self, **fields: Any) -> str:
        """Compute a simulation that succeeded, with a certificate, and a pyramid of extremes."""
        job = self._worker.submit(**RUN, output_step=1e-4, certificate=True, **fields)
        claim = self._worker.start(job)
        self._worker.store(claim, certificate=certificate_of(claim))
        self._worker.finish(claim, BlockState.done)
        return job

    def failed_run(self, **fields: Any) -> str:
        """Compute a simulation that failed on its way; what it had computed is sealed."""
        claim = self._worker.start(self._worker.submit(**RUN, **fields))
        self._catalogue.record_progress(
            claim.block.id, claim.block.attempt, 60.0, time=1.0, fraction=0.5, steps=7
        )
        self._worker.store(claim, complete=False)
        error = JobError("solver", "step-size-underflow", "The step fell below 1e-15 s.")
        self._worker.finish(claim, BlockState.failed, error)
        return claim.job.id

    def study(self, **fields: Any) -> str:
        """Compute a study, of whose points one failed."""
        return self._worker.finished_study(failing=(3,), **fields)

    def calibration(self, **fields: Any) -> str:
        """Compute a calibration; of other fields one with another seed."""
        job = self._submitted_calibration(fields)
        self._worker.work(job)
        return job

    def growing_calibration(self, **fields: Any) -> str:
        """Begin a calibration: the costs of its first candidates are known."""
        job = self._submitted_calibration(fields)
        block, spec = self._worker.start(job).block, self._catalogue.get(job).spec
        study = admit(spec)
        assert isinstance(study, Study)

        def report(progress: Progress) -> Answer:
            name, ended = progress.keep()
            self._catalogue.record_checkpoint(block.id, 1, watermark=ended, checkpoint=name)
            return Answer.leave if progress.fraction > 0.0 else Answer.go_on

        run_block(study, 0, self._settings.running_study(job).folder, report=report)
        return job

    def _submitted_calibration(self, fields: dict[str, Any]) -> str:
        search = CALIBRATION["search"] | {"seed": len(fields)}
        return self._worker.submit(**CALIBRATION | {"search": search})

    def growing_run(self, **fields: Any) -> str:
        """Begin a run: three full files of rows, and some that wait for the fourth."""
        claim = self._worker.start(self._worker.submit(**RUN, duration=2.0, **fields))
        admission = admit(claim.job.spec)
        assert isinstance(admission, Admission)
        attributes = {"job": admission.job, "digest": admission.digest, "section_note": ""}
        layout = ResultLayout(
            admission.channels,
            admission.samples,
            admission.sections,
            admission.joints,
            attributes,
            SMALL,
        )
        running = self._settings.running_run(claim.job.id, 1)
        writer = ResultWriter.create(running.folder, layout)
        columns = np.arange(len(layout.channels))
        time = np.linspace(0.0, 2.0, admission.samples)[:800]
        impacts = np.array([(1, 0.5, np.nan, 0.01, 100.0, 0.2)], IMPACT)
        shift = float(len(fields))  # another job's rows are others
        samples = columns + shift + time[:, None]
        writer.append(RunRows(sample_time=time, samples=samples, impacts=impacts))
        writer.checkpoint()
        self._catalogue.record_checkpoint(claim.block.id, 1, watermark=800, checkpoint="block0-a1")
        return claim.job.id

    def growing_study(self, **fields: Any) -> str:
        """Begin a study: a block that is done, one with some points, and one that waits."""
        job = self._worker.submit(**fields)
        for index, points in ((0, None), (1, 3)):
            claim = self._worker.start(job, index)
            self._worker.compute(claim, points=points)
            block = claim.block
            self._catalogue.record_checkpoint(
                block.id, 1, watermark=points or block.count, checkpoint=f"{index:05d}-a1"
            )
        return job


def certificate_of(claim: Claim) -> CertificateRecord:
    """Return a certificate of made-up numbers for all channels of a claimed run."""
    admission = admit(claim.job.spec)
    assert isinstance(admission, Admission)
    width = len(admission.channels)
    sizes = {
        "error": (len(INSTANTS), width),
        "until": (width,),
        "extremes": (width, 4),
        "edges": (EDGES, width),
        "share": (EDGES - 1, width),
        "spread": (EDGES - 1, width),
    }
    arrays = {"time": LabelledArray(INSTANTS, ("instant",), {"units": "s"})}
    for name, size in sizes.items():
        values = np.arange(1.0, 1.0 + np.prod(size)).reshape(size)
        dimensions = tuple(f"{name}_{axis}" for axis in range(len(size)))
        arrays[name] = LabelledArray(values, dimensions, {"long_name": name})
    return CertificateRecord({"note": "", "horizon": 2.0, "converged": [[0.0, 2.0]]}, arrays)


def computing(settings: Settings) -> Settings:
    """Return the settings of whoever computes in the data folder of a service."""
    return settings.model_copy(update={"running": "data"})


def _sealed_run(settings: Settings, job: str) -> StoredObject:
    return settings.sealed_run(job, 1)


def _sealed_study(settings: Settings, job: str) -> StoredObject:
    return settings.sealed_study(job)


def _running_run(settings: Settings, job: str) -> RunningFiles:
    return settings.running_files(job).below("a1")


def _running_study(settings: Settings, job: str) -> RunningFiles:
    return settings.running_files(job).below("study")


def _study_of(fields: dict[str, Any]) -> Callable[..., str]:
    return lambda subjects, **more: subjects.study(**fields, **more)


def _growing_study_of(fields: dict[str, Any]) -> Callable[..., str]:
    return lambda subjects, **more: subjects.growing_study(**fields, **more)


CALIBRATION: Final[dict[str, Any]] = bounce(
    search={"population": 4, "generations": 2}, spread={"generations": 2}
)
"""The shortest one: its results have all that those of longer ones have."""
POINCARE: Final = {"kind": "poincare", "record": 40}
ENSEMBLE: Final = {"kind": "ensemble", "members": 20, "record": 12}
LONG: Final = {"record": 5000}
"""Sections enough for a chunk that is full before its point has ended."""
WIDE: Final = {"grid": {"clearance": {"from": 1e-4, "to": 1e-3, "count": 20}}}
"""More points than one block has."""
_Store = Callable[[Settings, str], StoredObject | RunningFiles]
KINDS: Final[dict[str, tuple[Callable[..., str], _Store]]] = {
    "simulate": (Subjects.run, _sealed_run),
    "failed simulate": (Subjects.failed_run, _sealed_run),
    "bifurcation": (_study_of(BIFURCATION), _sealed_study),
    "sweep": (_study_of(SWEEP), _sealed_study),
    "poincare": (_study_of(POINCARE), _sealed_study),
    "ensemble": (_study_of(ENSEMBLE), _sealed_study),
    "accuracy-study": (_study_of(ACCURACY_STUDY), _sealed_study),
    "calibration": (Subjects.calibration, _sealed_study),
    "running simulate": (Subjects.growing_run, _running_run),
    "running bifurcation": (_growing_study_of(BIFURCATION | LONG), _running_study),
    "running sweep": (_growing_study_of(SWEEP | WIDE), _running_study),
    "running calibration": (Subjects.growing_calibration, _running_study),
    "running ensemble": (_growing_study_of(ENSEMBLE), _running_study),
}
"""Makers of the job of each kind of store, and the place of its store."""
