"""Runs a block of a study: its points in eight lanes, a lane refilled as soon as it is free.

A point's results depend on the study alone: lanes do not touch each other, and the clock decides
nothing but the length of slices. Points of another structure need another kernel; they wait until
the lanes of this one are done.
"""

import time
from collections.abc import Iterator, Sequence

from jointplay.records.point import PointEnd, StudySlice
from jointplay.solver.runs.budget import SliceBudget
from jointplay.solver.runs.study.lane_group import LaneGroup
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.restart_point import read, written


class StudyRun:
    """One block: `slices` computes it, `checkpoint` between slices restarts it bit for bit."""

    def __init__(self, study: Study, block: int, checkpoint: bytes | None = None) -> None:
        """Queue the block's chains of points, or take up where the checkpoint was made.

        Parameters
        ----------
        block
            Index into `study.blocks`.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        self.study = study
        first, self.count = study.blocks[block]
        self.waiting: list[PointRun] = []
        """Points that may begin, in the order of their chains."""
        self.group: LaneGroup | None = None
        """Points that are computed; none before the first slice."""
        self.ended = 0
        self.seconds = 0.0
        """Spent computing by this process since this object was made, without compiling."""
        self._ended_steps = 0.0
        self._reached = 0.0
        if checkpoint is not None:
            self._restore(checkpoint)
            return
        self.waiting = self._begin(first)

    def _begin(self, first: int) -> list[PointRun]:
        """Return the points that may begin, given the block's first."""
        chains = sorted({int(one) for one in self.study.chain_of[first : first + self.count]})
        return [PointRun(self.study.chain_order[chain][0], chain, 0) for chain in chains]

    @property
    def steps(self) -> float:
        """Accepted steps: of points that ended since this object was made, and under way."""
        return self._ended_steps + (self.group.steps if self.group else 0.0)

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every point of the block has ended."""
        budget = SliceBudget()
        while self.waiting or (self.group is not None and self.group.busy):
            group = self._group()
            started = group.fill(self.waiting)
            begun, worked = time.perf_counter(), time.process_time()
            before = group.bundle.attempts
            group.bundle.advance(budget.attempts)
            rows, ended, following = group.collect()
            self.waiting += following
            own = self._own(ended)
            self.ended += len(own)
            self._ended_steps += sum(end.statistics["steps"] for end in ended)
            budget.adapt(group.bundle.attempts - before, time.perf_counter() - begun)
            self.seconds += time.process_time() - worked
            yield StudySlice(self._fraction(group), self._begun(started), tuple(rows), own)

    def _group(self) -> LaneGroup:
        """Return the lanes that go on; those of another structure once all are free."""
        if self.group is not None and self.group.busy:
            return self.group
        structures = self.study.structure[[run.point for run in self.waiting]]
        if self.group is None or self.group.structure not in structures:
            self.group = LaneGroup(self.study, int(structures.min()))
        return self.group

    def _own(self, ended: Sequence[PointEnd]) -> tuple[PointEnd, ...]:
        """Return the ends that are results of the block."""
        return tuple(ended)

    def _begun(self, started: Sequence[int]) -> tuple[int, ...]:
        """Return those of points that were started whose results the block has."""
        return tuple(started)

    def _fraction(self, group: LaneGroup) -> float:
        """Return how much of the block is computed, 0..1; it never falls."""
        found = min((self.ended + group.under_way()) / self.count, 1.0)
        self._reached = max(self._reached, found)
        return self._reached

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        return written(self.ended, self.waiting, self.group)

    def _restore(self, checkpoint: bytes) -> None:
        self.ended, self.waiting, structure = read(checkpoint)
        if structure is not None:
            self.group = LaneGroup(self.study, structure)
