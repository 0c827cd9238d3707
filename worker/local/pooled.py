"""Blocks of a study on lanes of a device, as many at once as there are lanes for."""

import json
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from jointplay.records.job import JobError
from jointplay.records.point import StudySlice
from jointplay.solver.computations import computation_of
from jointplay.solver.kernels.device.driver import DeviceError
from jointplay.solver.runs.processes import Advance, Call
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.run import StudyRun
from jointplay.storage.studies.block import StudyBlock
from jointplay.worker.execute import Answer, Outcome, Progress
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.local.block_attempts import BlockAttempt
from jointplay.worker.local.devices import Lanes
from jointplay.worker.local.restart_points import RestartPoints
from jointplay.worker.local.study_of import study_of
from jointplay.worker.study_block import begin_block

LAUNCH = 0.3
"""Aimed-at seconds of a launch: an end that is asked for waits no longer."""


def compute_pooled(
    study: Study,
    folder: Path,
    attempts: Mapping[int, BlockAttempt],
    device: Lanes,
    go_on: Callable[[Progress], bool],
) -> Outcome:
    """Compute blocks into a store, each from its restart point if there is one.

    Parameters
    ----------
    study
        As admitted.
    folder
        Of the store.
    attempts
        Next attempt at each of the blocks, by its index.
    device
        What opens the device.
    go_on
        Hears between launches how far the blocks are, and says whether to go on.

    Returns
    -------
    Outcome
        "left" where it was not to go on, or "failed" because the device did: restart points are
        kept.
    """
    blocks, waiting = _Blocks(study, folder, attempts), deque(attempts)
    restart_points, pool = RestartPoints(go_on, Answer.leave), Pool(study, device(study), LAUNCH)
    try:
        while waiting or pool.runs:
            while waiting and pool.room > 0:
                for run in blocks.begin(waiting.popleft()):
                    pool.add(run)
            if restart_points(blocks.progress()) is Answer.leave:
                return Outcome("left", 0.0, blocks.progress().fraction)
            if pool.runs:
                for run, piece in pool.advance():
                    blocks.take(run, piece)
    except DeviceError as error:
        return _lost(error, blocks.progress().fraction)
    finally:
        pool.release()
    return Outcome("succeeded", 0.0, 1.0)


def calls_of_parts(
    study: Study, folder: Path, attempts: Mapping[int, BlockAttempt], count: int, device: Lanes
) -> list[Call]:
    """Return a call for each of so many processes: every `count`-th block, by lanes of its own.

    The device has the launches of one after the other; the others prepare and judge points.
    """
    job = json.dumps(study.job)
    parts = [{index: attempts[index] for index in [*attempts][k::count]} for k in range(count)]
    sizes = [sum(study.blocks[index][1] for index in part) for part in parts]
    return [
        Call(_compute_part, (job, str(folder), part, device), size, size)
        for part, size in zip(parts, sizes, strict=True)
    ]


def _compute_part(
    job: str, folder: str, attempts: Mapping[int, BlockAttempt], device: Lanes, advance: Advance
) -> Outcome:
    def go_on(done: Progress) -> bool:
        return advance(done.fraction, done.watermark)

    return compute_pooled(study_of(job), Path(folder), attempts, device, go_on)


class _Blocks:
    """The stores of blocks, and what computes those that are under way."""

    def __init__(self, study: Study, folder: Path, attempts: Mapping[int, BlockAttempt]) -> None:
        self._study, self._folder, self._attempts = study, folder, attempts
        self._layout = layout_of_study(study)
        self._under_way: dict[int, tuple[StudyRun, StudyBlock]] = {}
        self._fractions = dict.fromkeys(attempts, 0.0)
        self._ended = 0
        """Points of blocks that are done."""

    def begin(self, index: int) -> Iterator[StudyRun]:
        """Yield what computes a block, unless nothing of it is left to compute."""
        if StudyBlock.done(self._folder, self._layout, index):
            self._end(index)
            return
        number, name = self._attempts[index]
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
        counts = {index: self._study.blocks[index][1] for index in self._fractions}
        computed = sum(counts[index] * fraction for index, fraction in self._fractions.items())
        ended = self._ended + sum(block.watermark for _, block in self._under_way.values())
        return Progress(0.0, computed / sum(counts.values()), self._keep, lambda: None, ended)

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
