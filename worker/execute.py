"""The one loop that turns a checked job into a results store, for workers and local runs."""

import logging
import math
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Literal

from jointplay.records.checkpoint import UnusableCheckpoint
from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.records.job import ErrorClass, JobError
from jointplay.solver.kernels.watched import (
    CompilationEnded,
    CompilationTooLong,
    CompilationUnwanted,
)
from jointplay.solver.kinds import Admission
from jointplay.solver.runs.simulate import Simulation
from jointplay.storage.errors import CheckpointMismatch, CorruptStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.worker.certificates import record_of
from jointplay.worker.checkpoints import RestartPoint
from jointplay.worker.layouts import layout_of_run
from jointplay.worker.spent import publishing

_log = logging.getLogger(__name__)
_LIMIT_CODES = frozenset({"step-limit", "time-limit"})


class Answer(StrEnum):
    """Reply to a report: whether the loop goes on."""

    go_on = "continue"
    cancel = "cancel"  # close the store with what there is
    leave = "leave"  # touch the store no more: another worker continues it, or it is not ours


@dataclass(frozen=True)
class Progress:
    """State of a block between two slices. `keep()` is valid until the report returns."""

    time: float  # simulated time [s]; 0 of a study
    fraction: float  # 0..1, of the block
    keep: Callable[[], tuple[str, int]]
    """Brings a restart point to the disk; gives its name, and the samples or points that readers
    may see."""
    steps: Callable[[], int | None]  # accepted steps of this try so far
    watermark: int = 0  # points of a study that have ended


Report = Callable[[Progress], Answer | str]
"""Called before each slice of at most about 0.25 s of computing, hence several times a second;
answers "continue", "cancel" or "leave"."""


@dataclass(frozen=True)
class Outcome:
    """End of a run; `left` means that it did not end, and its store is open."""

    state: Literal["succeeded", "failed", "cancelled", "left"]
    time: float  # simulated time reached [s]
    fraction: float  # 0..1
    error: JobError | None = None
    statistics: Mapping[str, Any] | None = field(default=None, compare=False)


def execute(
    admission: Admission,
    folder: Path,
    target: StoredObject,
    *,
    report: Report,
    resume_from: str | None = None,
    longest: float = math.inf,
) -> Outcome:
    """Simulate a checked job and write its results store.

    Parameters
    ----------
    admission
        The job as `solver.kinds.admit` filled it in.
    folder
        Where the store grows; made here, and must not hold a store.  Restart points go beside it.
    target
        Where the sealed store goes.
    report
        Hears how far the run is, and says whether to go on.
    resume_from
        Name of a restart point of an earlier try at the same job, which is only read; where it, or
        what that try wrote, is no good the run begins anew.
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
    writer, restart = _begin(folder, layout_of_run(admission), resume_from)
    begin = (restart.time, restart.fraction) if restart else (0.0, 0.0)
    simulation = _made_ready(admission, restart.simulation if restart else None, begin)
    if isinstance(simulation, Outcome):
        if simulation.state != "left":
            writer.seal(target, peaks={}, summary={}, complete=False)
        return simulation
    outcome = _advance(simulation, longest, writer, folder, report, begin)
    if outcome.state == "left":
        return outcome
    summary, certificate = simulation.summary(), simulation.certificate()
    statistics = _storable(summary.statistics)
    with publishing():
        writer.seal(
            target,
            peaks=summary.peaks,
            summary=statistics,
            complete=outcome.state == "succeeded",
            certificate=None if certificate is None else record_of(certificate),
        )
    return replace(outcome, statistics=statistics)


def _storable(statistics: Mapping[str, Any]) -> dict[str, Any]:
    """Return statistics without a ledger whose works are beyond all numbers, which JSON has not."""
    energy = statistics["energy"]
    known = energy is None or all(map(math.isfinite, energy.values()))
    return {**statistics, "energy": energy if known else None}


def _begin(
    folder: Path, layout: ResultLayout, resume_from: str | None
) -> tuple[ResultWriter, RestartPoint | None]:
    """Return a writer and the restart point that it goes on from; none if its rows are lost."""
    if resume_from is not None:
        try:
            restart = RestartPoint.load(folder.with_name(resume_from))
            writer = ResultWriter.resume(
                folder, layout, restart.results, taken_over_from=restart.folder
            )
            return writer, restart
        except (UnusableCheckpoint, CheckpointMismatch, CorruptStore, FileNotFoundError) as error:
            _log.warning("the run begins anew: %s", error)
            shutil.rmtree(folder, ignore_errors=True)
    return ResultWriter.create(folder, layout), None


def _made_ready(
    admission: Admission, checkpoint: bytes | None, begin: tuple[float, float]
) -> Simulation | Outcome:
    """Return the simulation, or how the run ends before it has begun."""
    try:
        return Simulation(admission, checkpoint)
    except InvalidInput as refused:
        return Outcome("failed", *begin, JobError("user", "invalid-input", str(refused)))
    except CompilationEnded as ended:
        return uncompiled(ended, *begin)


def _advance(
    simulation: Simulation,
    longest: float,
    writer: ResultWriter,
    folder: Path,
    report: Report,
    begin: tuple[float, float],
) -> Outcome:
    """Run to the end, to an error, or to an answer other than to go on."""
    slices = simulation.slices(longest)
    time, fraction = begin

    def keep() -> tuple[str, int]:
        path = folder.with_name(restart_name(folder.name))
        checkpoint = simulation.checkpoint(), writer.checkpoint()
        RestartPoint(*checkpoint, folder, writer.samples, time, fraction).store(path)
        return path.name, writer.samples

    def steps() -> int:
        return int(simulation.summary().statistics["steps"])

    while True:
        answer = Answer(report(Progress(time, fraction, keep, steps)))
        if answer is Answer.leave:
            return Outcome("left", time, fraction)
        if answer is Answer.cancel:
            return Outcome("cancelled", time, fraction)
        try:
            piece = next(slices, None)
        except SimulationFailed as failure:
            error_class: ErrorClass = "limit" if failure.code in _LIMIT_CODES else "solver"
            error = JobError(error_class, failure.code, failure.detail, failure.time)
            return Outcome("failed", failure.time, fraction, error)
        except CompilationEnded as ended:
            return uncompiled(ended, time, fraction)
        if piece is None:
            return Outcome("succeeded", time, fraction)
        writer.append(piece)
        time, fraction = piece.time, piece.fraction


def restart_name(store: str) -> str:
    """Return the name of a try's restart point, a file beside the folder `store` of its results."""
    return f"block0-{store}"


def uncompiled(ended: CompilationEnded, time: float, fraction: float) -> Outcome:
    """Return the outcome of a block whose code was not compiled to its end."""
    if isinstance(ended, CompilationTooLong):
        return Outcome("failed", time, fraction, JobError("limit", ended.code, str(ended)))
    left = isinstance(ended, CompilationUnwanted) and ended.answer is Answer.leave
    return Outcome("left" if left else "cancelled", time, fraction)
