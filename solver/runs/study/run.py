"""Runs a block of a study: its points in eight lanes, a lane refilled as soon as it is free.

A point's results depend on the study alone: lanes do not touch each other, and the clock decides
nothing but the length of slices. Points of another structure need another kernel; they wait until
the lanes of this one are done.
"""

from collections.abc import Iterator, Sequence

from jointplay.records.point import PointEnd, StudySlice
from jointplay.solver.runs.study.lane_group import LaneGroup
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_news import PointNews
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.restart_point import read, written


class StudyRun:
    """One block: `slices` computes it, `checkpoint` between slices restarts it bit for bit.

    Or a `Pool` computes it beside others.
    """

    def __init__(self, study: Study, block: int, checkpoint: bytes | None = None) -> None:
        """Queue the block's chains of points, or take up where the checkpoint was made.

        Parameters
        ----------
        block
            Index into `study.blocks`.
        """
        self.study, self.block = study, block
        first, self.count = study.blocks[block]
        self.waiting: list[PointRun] = []
        """Points that may begin, in the order of their chains."""
        self.group: LaneGroup | None = None
        """Lanes that compute its points; none before the first slice."""
        self.ended = 0
        self._alone = Pool(study)
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
    def seconds(self) -> float:
        """Spent computing by `slices` since this object was made, without compiling."""
        return self._alone.seconds

    @property
    def steps(self) -> float:
        """Accepted steps: of points that ended since this object was made, and under way."""
        group, steps = self.group, self._ended_steps
        lanes = () if group is None else map(group.bundle.lane, group.runs_of(self.block))
        return steps + sum(lane.steps for lane in lanes)

    @property
    def over(self) -> bool:
        """Whether no point waits or is under way."""
        return not self.waiting and (self.group is None or not self.group.computes(self.block))

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every point of the block has ended.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        if not self._alone.runs:
            self._alone.add(self)
        while not self.over:
            ((_, piece),) = self._alone.advance()
            yield piece

    def take(self, started: Sequence[int], found: PointNews) -> StudySlice:
        """Take what lanes have given of its points. Returns what is new of the block."""
        begun = self._begun(started)
        self.waiting += found.following
        own = self._own(found.ended)
        self.ended += len(own)
        self._ended_steps += sum(end.statistics["steps"] for end in found.ended)
        return StudySlice(self._fraction(), begun, tuple(found.rows), own)

    def _own(self, ended: Sequence[PointEnd]) -> tuple[PointEnd, ...]:
        """Return the ends that are results of the block."""
        return tuple(ended)

    def _begun(self, started: Sequence[int]) -> tuple[int, ...]:
        """Return those of points that were started whose results the block has."""
        return tuple(started)

    def _fraction(self) -> float:
        """Return how much of the block is computed, 0..1; it never falls."""
        under_way = self.group.under_way(self.block) if self.group else 0.0
        self._reached = max(self._reached, min((self.ended + under_way) / self.count, 1.0))
        return self._reached

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        return written(self.ended, self.waiting, self.group, self.block)

    def _restore(self, checkpoint: bytes) -> None:
        self.ended, self.waiting = read(checkpoint)
