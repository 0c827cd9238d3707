"""The one loop that turns a checked job into a results store, for workers and local runs."""

import logging
import math
import shutil
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Generic, Literal, TypeVar

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.records.job import JobError
from jointplay.solver.kinds import Admission
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.results import Slice, Summary
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.errors import CheckpointMismatch, CorruptStore
from jointplay.storage.places import StoredObject
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.worker.certificates import record_of

_log = logging.getLogger(__name__)
EndState = Literal["succeeded", "failed", "cancelled", "left"]
_LIMIT_CODES = frozenset({"step-limit", "time-limit"})


class Answer(StrEnum):
    """Reply to a report: whether the loop goes on."""

    go_on = "continue"
    cancel = "cancel"  # close the store with what there is
    leave = "leave"  # touch the store no more: another worker continues it, or it is not ours


@dataclass(frozen=True)
class RestartPoint:
    """Simulation and results store at one instant; both are needed to go on from it."""

    simulation: bytes
    results: bytes
    folder: Path  # of the store that `results` belongs to
    watermark: int  # samples readers may see: all so far, as `results` brought them to the disk
    time: float  # simulated time [s]
    fraction: float  # 0..1


Kept = TypeVar("Kept", covariant=True)


@dataclass(frozen=True)
class Progress(Generic[Kept]):
    """State of a block between two slices. `restart_point()` is valid until the report returns."""

    time: float  # simulated time [s]; 0 of a study
    fraction: float  # 0..1, of the block
    restart_point: Callable[[], Kept]
    steps: Callable[[], int | None] = lambda: None  # accepted steps of this try so far
    watermark: int = 0  # points of a study that have ended


@dataclass(frozen=True)
class Outcome:
    """End of a run; `left` means that it did not end, and its store is open."""

    state: EndState
    time: float  # simulated time reached [s]
    fraction: float  # 0..1
    error: JobError | None = None
    statistics: Mapping[str, Any] | None = field(default=None, compare=False)


def execute(
    admission: Admission,
    folder: Path,
    target: StoredObject,
    *,
    report: Callable[[Progress[RestartPoint]], Answer | str],
    restart: RestartPoint | None = None,
    longest: float = math.inf,
) -> Outcome:
    """Simulate a checked job and write its results store.

    Parameters
    ----------
    admission
        The job as `solver.kinds.admit` filled it in.
    folder
        Where the store grows; made here, and must not hold a store.
    target
        Where the sealed store goes.
    report
        Called before each slice of at most about 0.25 s of computing, hence several times a
        second; answers "continue", "cancel" or "leave".
    restart
        Where an earlier run of the same job left off; its folder is only read. Where what it
        wrote is not there any more the run begins anew.
    longest
        Seconds of computing after which the run fails.

    Returns
    -------
    Outcome
        The store is sealed and durable, unless the state is "left"; the folder stays, for those
        who read it.

    Raises
    ------
    StoreExists
        The folder or the target holds results already.
    OSError
        The store cannot be written, for example because the disk is full.
    """
    writer, restart = _begin(folder, layout_of(admission), restart)
    begin = (restart.time, restart.fraction) if restart else (0.0, 0.0)
    try:
        simulation = Simulation(admission, restart.simulation if restart else None)
    except InvalidInput as refused:
        writer.seal(target, peaks={}, summary={}, complete=False)
        return Outcome("failed", *begin, JobError("user", "invalid-input", str(refused)))
    outcome = _advance(simulation, simulation.slices(longest), writer, folder, report, begin)
    if outcome.state == "left":
        return outcome
    summary = simulation.summary()
    _seal(writer, target, summary, simulation.certificate(), complete=outcome.state == "succeeded")
    return replace(outcome, statistics=summary.statistics)


def _begin(
    folder: Path, layout: ResultLayout, restart: RestartPoint | None
) -> tuple[ResultWriter, RestartPoint | None]:
    """Return a writer and the restart point that it goes on from; none if its rows are lost."""
    if restart is not None:
        try:
            writer = ResultWriter.resume(
                folder, layout, restart.results, taken_over_from=restart.folder
            )
            return writer, restart
        except (CheckpointMismatch, CorruptStore, FileNotFoundError) as error:
            _log.warning("the run begins anew: %s", error)
            shutil.rmtree(folder, ignore_errors=True)
    return ResultWriter.create(folder, layout), None


def _advance(
    simulation: Simulation,
    slices: Iterator[Slice],
    writer: ResultWriter,
    folder: Path,
    report: Callable[[Progress[RestartPoint]], Answer | str],
    begin: tuple[float, float],
) -> Outcome:
    """Run to the end, to an error, or to an answer other than to go on."""
    time, fraction = begin

    def restart_point() -> RestartPoint:
        return RestartPoint(
            simulation.checkpoint(),
            writer.checkpoint(),
            folder,
            writer.samples,
            time,
            fraction,
        )

    def steps() -> int:
        return int(simulation.summary().statistics["steps"])

    while True:
        answer = Answer(report(Progress(time, fraction, restart_point, steps)))
        if answer is Answer.leave:
            return Outcome("left", time, fraction)
        if answer is Answer.cancel:
            return Outcome("cancelled", time, fraction)
        try:
            piece = next(slices, None)
        except SimulationFailed as failure:
            error_class: Literal["limit", "solver"] = (
                "limit" if failure.code in _LIMIT_CODES else "solver"
            )
            error = JobError(error_class, failure.code, failure.detail, failure.time)
            return Outcome("failed", failure.time, fraction, error)
        if piece is None:
            return Outcome("succeeded", time, fraction)
        writer.append(
            piece.first_sample,
            piece.sample_time,
            piece.samples,
            piece.first_section,
            piece.section_time,
            piece.sections,
            piece.impacts,
        )
        time, fraction = piece.time, piece.fraction


def layout_of(admission: Admission) -> ResultLayout:
    """Return what a run's store holds."""
    return ResultLayout(
        channels=admission.channels,
        samples=admission.samples,
        sections=admission.sections,
        joints=admission.joints,
        attributes={
            "job": admission.job,
            "scene": admission.scene_document(),
            "digest": admission.digest,
            "solver_version": SOLVER_VERSION,
            "period": admission.period,
            "section_note": admission.section_note,
        },
    )


def _seal(
    writer: ResultWriter,
    target: StoredObject,
    summary: Summary,
    certificate: Certificate | None,
    *,
    complete: bool,
) -> None:
    record = None if certificate is None else record_of(certificate)
    writer.seal(
        target,
        peaks=summary.peaks,
        summary=summary.statistics,
        complete=complete,
        certificate=record,
    )
