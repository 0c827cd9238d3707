"""All blocks of a study on lanes of a device, as many blocks at once as there are lanes for."""

from collections import deque
from collections.abc import Callable, Iterator, Mapping
from operator import mul
from pathlib import Path

from jointplay.records.job import JobError
from jointplay.records.point import StudySlice
from jointplay.solver.computations import computation_of
from jointplay.solver.kernels.device.driver import DeviceError
from jointplay.solver.runs.study.lane_group import Make
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.run import StudyRun
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.layout import StudyLayout
from jointplay.worker.execute import Answer, Outcome, Progress
from jointplay.worker.local.keeping import Keeping
from jointplay.worker.local.tries_at_blocks import Try
from jointplay.worker.study_block import begin_block

LAUNCH = 0.3
"""Aimed-at seconds of a launch: an end that is asked for waits no longer."""
Report = Callable[[float, str], None]


def compute_pooled(
    study: Study,
    layout: StudyLayout,
    folder: Path,
    tries: Mapping[int, Try],
    make: Make,
    report: Report,
    asked_to_end: Callable[[], bool],
) -> list[Outcome]:
    """Compute all blocks into a store, each from its restart point if there is one.

    Parameters
    ----------
    study, layout
        The layout is the study's.
    folder
        Of the store.
    tries
        Next try at each block that was begun.
    make
        What has the lanes; see `LaneGroup`.
    report, asked_to_end
        See `compute_study`.

    Returns
    -------
    list of Outcome
        One for each block that succeeded. Or one that failed, because the device did; then, and
        where an end was asked for, restart points are kept.
    """
    blocks = _Blocks(study, layout, folder, tries)

    def go_on(done: Progress) -> bool:
        report(done.fraction, f"{done.watermark} of {study.points} points")
        return not asked_to_end()

    keeping, pool = Keeping(go_on, Answer.leave), Pool(study, make, LAUNCH)
    waiting = deque(range(len(study.blocks)))
    try:
        while waiting or pool.runs:
            while waiting and pool.room > 0:
                for run in blocks.begin(waiting.popleft()):
                    pool.add(run)
            if keeping(blocks.progress()) is Answer.leave:
                return []
            if pool.runs:
                for run, piece in pool.advance():
                    blocks.take(run, piece)
    except DeviceError as error:
        return [_lost(error, blocks.progress().fraction)]
    return [Outcome("succeeded", 0.0, 1.0) for _ in study.blocks]


class _Blocks:
    """The stores of blocks, and what computes those that are under way."""

    def __init__(
        self, study: Study, layout: StudyLayout, folder: Path, tries: Mapping[int, Try]
    ) -> None:
        self._study, self._layout, self._folder, self._tries = study, layout, folder, tries
        self._under_way: dict[int, tuple[StudyRun, StudyBlock]] = {}
        self._fractions = [0.0] * len(study.blocks)
        self._ended = 0
        """Points of blocks that are done."""

    def begin(self, index: int) -> Iterator[StudyRun]:
        """Yield what computes a block, unless nothing of it is left to compute."""
        if StudyBlock.done(self._folder, self._layout, index):
            self._end(index)
            return
        number, name = self._tries.get(index, Try())
        restart = None if name is None else (name, 0.0)
        block, carried, _ = begin_block(self._layout, index, self._folder, number, restart)
        run = computation_of(self._study, index, carried)
        assert isinstance(run, StudyRun)  # noqa: S101  (of such studies alone)
        if run.over:
            block.finish()
            self._end(index)
            return
        self._under_way[index] = run, block
        yield run

    def take(self, run: StudyRun, piece: StudySlice) -> None:
        """Store what is new of a block, and finish it if it is over."""
        _, block = self._under_way[run.block]
        block.take(piece)
        self._fractions[run.block] = piece.fraction
        if run.over:
            block.finish()
            del self._under_way[run.block]
            self._end(run.block)

    def _end(self, index: int) -> None:
        self._fractions[index] = 1.0
        self._ended += self._study.blocks[index][1]

    def progress(self) -> Progress:
        """Return how far all blocks are."""
        counts = [count for _, count in self._study.blocks]
        computed = sum(map(mul, self._fractions, counts))
        ended = self._ended + sum(block.watermark for _, block in self._under_way.values())
        return Progress(0.0, computed / sum(counts), self._keep, lambda: None, ended)

    def _keep(self) -> tuple[str, int]:
        """Bring restart points of all blocks under way to the disk."""
        for run, block in self._under_way.values():
            block.flush(run.checkpoint())
        return "", 0


def _lost(error: DeviceError, fraction: float) -> Outcome:
    sentence = (
        f"The device does not go on ({error}). What was computed up to the last restart point is"
        " kept: --resume goes on from there, with or without a device."
    )
    return Outcome("failed", 0.0, fraction, JobError("platform", "device-lost", sentence))
