"""Extremes of points, of their whole run or from the time on that a sweep leaves out as settling.

The latter are sought in the steps, as those of a simulation are: no run stops where settling ends,
so that a point has the bits of its run alone.
"""

from dataclasses import astuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.dense_output.replay import ProblemReplay
from jointplay.solver.runs.lane_results import peaks_of
from jointplay.solver.runs.settled_peaks import SettledPeaks
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun

_NAME = "extremes"
STATE = (f"{_NAME}/record", f"{_NAME}/book")
"""Arrays in a point's `extremes`."""


def lanes_that_keep_steps(study: Study) -> int:
    """Return how many lanes of a bundle hand out their steps: all where points settle."""
    wanted = bool(study.channels) and bool(np.any(study.settle > 0.0))
    return BUNDLE if wanted else 0


class PointExtremes:
    """Extremes of the points that a bundle's lanes compute."""

    def __init__(self, study: Study, bundle: Bundle) -> None:
        self._study, self._bundle = study, bundle
        self._names = [channel.name for channel in study.channels]
        self._settled: dict[int, SettledPeaks] = {}
        """By point, of those that lanes compute."""

    def take(self, lane: int, run: PointRun) -> None:
        """Look at the steps that a lane has made of a point."""
        if self._settles(run):
            settled = self._of_point(run)
            settled.add(self._bundle.steps(lane))
            run.extremes = settled.state(_NAME)

    def end(self, lane: int, run: PointRun) -> Floats:
        """Return the extremes of a point that has ended, (channels, 4); NaN if it never settled."""
        if self._settles(run):
            peaks = self._of_point(run).peaks()
            del self._settled[run.point]
        else:
            peaks = peaks_of(self._bundle, lane, self._names)
        if not peaks:
            return np.full((len(self._names), 4), np.nan)
        return np.array([astuple(peaks[name]) for name in self._names])

    def _settles(self, run: PointRun) -> bool:
        study = self._study
        return bool(self._names) and bool(study.settle[run.point] > 0.0)

    def _of_point(self, run: PointRun) -> SettledPeaks:
        """Return what seeks the extremes of a point, from where it was taken up."""
        study, point = self._study, run.point
        if point not in self._settled:
            end = float(study.duration[point])
            problem = LaneProblem(study.point_scene(point), end, study.tolerance, end, 0, 0, 0.0)
            replay = ProblemReplay(self._bundle.kernel, problem)
            settled = SettledPeaks(replay, self._names, float(study.settle[point]), end)
            if run.extremes:
                settled.restore(run.extremes, _NAME)
            self._settled[point] = settled
        return self._settled[point]
