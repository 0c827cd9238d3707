"""Lanes that compute points of several blocks at once: eight here, tens of thousands of a device.

A lane that is free takes the next point that waits. Lanes do not touch each other, so each block
has the results, and the restart points, that it would have alone.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from jointplay.records.point import StudySlice
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.budget import SLICE_SECONDS, SliceBudget
from jointplay.solver.runs.study.lane_group import LaneGroup, Make
from jointplay.solver.runs.study.plan import Study

if TYPE_CHECKING:
    from jointplay.solver.runs.study.run import StudyRun


class Pool:
    """Blocks of a study, and the lanes of one structure after the other that compute them."""

    def __init__(self, study: Study, make: Make = Bundle, slice_seconds: float = SLICE_SECONDS):
        """Compute nothing yet.

        Parameters
        ----------
        make
            See `LaneGroup`.
        slice_seconds
            Aimed-at time in kernels between two returns, s.
        """
        self.seconds = 0.0
        """Processor time spent computing by this process, without compiling."""
        self.launched = 0.0
        """Seconds spent in kernels."""
        self.group: LaneGroup | None = None
        """None before the first slice."""
        self.runs: list[StudyRun] = []
        """Blocks that are not over."""
        self._study, self._make = study, make
        self._budget = SliceBudget(slice_seconds)

    @property
    def room(self) -> int:
        """Number of lanes for which no point of the blocks waits; 1 while there are no lanes."""
        if self.group is None:
            return int(not self.runs)
        return self.group.free - sum(len(run.waiting) for run in self.runs)

    def add(self, run: StudyRun) -> None:
        """Compute a block, too, from where it is."""
        self.runs.append(run)

    def release(self) -> None:
        """Give back what lanes have elsewhere: nothing is computed any more."""
        if self.group is not None:
            self.group.bundle.release()

    def drop(self, block: int) -> None:
        """Compute a block no more, if it is one of the pool's."""
        self.runs = [run for run in self.runs if run.block != block]
        if self.group is not None:
            self.group.drop(block)

    def advance(self) -> list[tuple[StudyRun, StudySlice]]:
        """Compute a slice of the blocks that are not over, of which there is one.

        Returns what is new of each.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        group = self._lanes()
        worked = time.process_time()
        started = [group.fill(run.waiting, run.block) for run in self.runs]
        before = group.bundle.attempts
        begun = time.perf_counter()
        group.bundle.advance(self._budget.attempts)
        spent = time.perf_counter() - begun
        self._budget.adapt(group.bundle.attempts - before, spent)
        self.launched += spent
        news = group.collect()
        found = [
            (run, run.take(points, news[run.block]))
            for run, points in zip(self.runs, started, strict=True)
        ]
        self.runs = [run for run in self.runs if not run.over]
        self.seconds += time.process_time() - worked
        return found

    def _lanes(self) -> LaneGroup:
        """Return the lanes that go on; those of another structure once all are free."""
        group = self.group
        if group is None or not group.busy:
            points = [one.point for run in self.runs for one in run.waiting]
            structures = self._study.structure[points]
            if group is None or group.structure not in structures:
                self.release()
                group = self.group = LaneGroup(self._study, int(structures.min()), self._make)
        for run in self.runs:
            run.group = group
        return group
