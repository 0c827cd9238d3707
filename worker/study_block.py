"""From one block of a study to the study's store, for workers and local runs."""

import logging
import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from pathlib import Path

from jointplay.records.job import JobError
from jointplay.records.point import StudySlice
from jointplay.solver.calibration.calibrate import NothingFits
from jointplay.solver.computations import Computation, computation_of
from jointplay.solver.kernels.watched import CompilationEnded
from jointplay.solver.runs.study.plan import Study
from jointplay.storage.errors import ResultsError
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.store import create
from jointplay.worker.execute import Answer, Outcome, Progress, Report, uncompiled
from jointplay.worker.layouts import layout_of_study

_log = logging.getLogger(__name__)
ComputationOf = Callable[[Study, int, bytes | None], Computation]
_computation: ContextVar[ComputationOf] = ContextVar("computation", default=computation_of)


@contextmanager
def computed_by(computation: ComputationOf) -> Iterator[None]:
    """Have blocks computed by another computation of them than `computation_of`, to equal bits."""
    token = _computation.set(computation)
    try:
        yield
    finally:
        _computation.reset(token)


def run_block(
    study: Study,
    index: int,
    folder: Path,
    *,
    report: Report = lambda _: Answer.go_on,
    attempt: int = 1,
    resume_from: tuple[str, float] | None = None,
    layout: StudyLayout | None = None,
    longest: float = math.inf,
) -> Outcome:
    """Compute a block and write it to the study's store, which is made if need be.

    Parameters
    ----------
    study
        As `solver.kinds.admit` returned it.
    index
        Of the block in `study.blocks`.
    folder
        Of the store.
    report
        Hears how far the block is, and says whether to go on.
    attempt
        Which try at the block this is: every try needs a number of its own.
    resume_from
        Name of a restart point of an earlier try, and the fraction of the block at which it was
        made. Where it is no good the block begins anew.
    layout
        The study's, if it is at hand.
    longest
        Seconds of computing after which the block fails.

    Returns
    -------
    Outcome
        "succeeded" also if points failed, which the store says; "cancelled" and "left" keep what
        was computed in the store.

    Raises
    ------
    InvalidInput
        The study cannot be computed after all.
    StoreExists
        The folder holds other results, or this study's by another version of the solver.
    OSError
        The store cannot be written.
    """
    layout = layout or layout_of_study(study)
    create(folder, layout)
    if StudyBlock.done(folder, layout, index):
        return Outcome("succeeded", 0.0, 1.0)
    begin = begin_block(layout, index, folder, attempt, resume_from)
    return _compute(study, index, *begin, report, longest)


def _compute(
    study: Study,
    index: int,
    block: StudyBlock,
    carried: bytes | None,
    fraction: float,
    report: Report,
    longest: float,
) -> Outcome:
    """Compute a block from a restart point, or anew; see `run_block`."""
    steps = int(block.total("steps"))  # of an earlier try, whose points are in the store
    begun = time.monotonic()
    try:
        computation = _computation.get()(study, index, carried)
        slices = computation.slices()

        def keep() -> tuple[str, int]:
            return block.flush(computation.checkpoint()), block.watermark

        while True:
            known = partial(int, steps)
            answer = Answer(report(Progress(0.0, fraction, keep, known, block.watermark)))
            if answer is Answer.leave:
                return Outcome("left", 0.0, fraction)
            if answer is Answer.cancel:
                block.flush(b"")
                return Outcome("cancelled", 0.0, fraction)
            piece: StudySlice | None = next(slices, None)
            if piece is None:
                block.finish()
                return Outcome("succeeded", 0.0, 1.0, statistics={"steps": steps})
            block.take(piece)
            if time.monotonic() - begun > longest and piece.fraction < 1.0:
                block.flush(b"")
                return Outcome("failed", 0.0, piece.fraction, _out_of_time(longest, piece.fraction))
            steps += sum(int(point.statistics.get("steps", 0)) for point in piece.ended)
            fraction = piece.fraction
    except NothingFits as nothing:
        block.flush(b"")
        return Outcome("failed", 0.0, fraction, JobError("solver", "nothing-fits", str(nothing)))
    except CompilationEnded as ended:
        outcome = uncompiled(ended, 0.0, fraction)
        if outcome.state != "left":
            block.flush(b"")
        return outcome


def _out_of_time(seconds: float, fraction: float) -> JobError:
    return JobError(
        "limit",
        "time-limit",
        f"{fraction:.1%} of a block of the study's points were computed in {seconds:g} s, the limit"
        " of a block. Ask for fewer periods or a larger tolerance.",
    )


def begin_block(
    layout: StudyLayout,
    index: int,
    folder: Path,
    attempt: int,
    resume_from: tuple[str, float] | None,
) -> tuple[StudyBlock, bytes | None, float]:
    """Return a block's store, what continues its computation, and how far that had come.

    See `run_block` for `attempt` and `resume_from`.
    """
    if resume_from is not None:
        name, fraction = resume_from
        try:
            block, carried = StudyBlock.resume(folder, layout, index, attempt, name)
            if carried:
                return block, carried, fraction
            _log.warning("block %s had ended, which nobody was told: it begins anew", index)
        except (FileNotFoundError, ResultsError) as error:
            _log.warning("block %s begins anew: %s", index, error)
    return StudyBlock(folder, layout, index, attempt), None, 0.0
