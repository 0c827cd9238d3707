"""The lanes that compute points of one structure, side by side: seed, settle, record, judge."""

from collections.abc import Callable, Iterator
from itertools import islice

import numpy as np

from jointplay.records.point import PointEnd, SectionRows
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import LaneStart
from jointplay.solver.kernels.loop.ready_lanes import ReadyLanes
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.runs.study.finer import COST, periods_of
from jointplay.solver.runs.study.held_starts import end_of_start
from jointplay.solver.runs.study.judge import judged, looks_again, looks_longer
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_extremes import lanes_that_keep_steps
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.problem import begin_point, problem_of, ready
from jointplay.solver.runs.study.record import Recording
from jointplay.solver.runs.study.settle import goes_on
from jointplay.solver.runs.study.several_starts import from_next_start, of_all_starts

AT_ONCE = 64
"""Points that are made ready together."""

Make = Callable[..., Bundle]
Collected = tuple[list[SectionRows], list[PointEnd], list[PointRun]]
"""Sections, points that ended, and those that may follow them."""


class LaneGroup:
    """A kernel's lanes, each with the point that it computes, or free."""

    def __init__(self, study: Study, structure: int, make: Make = Bundle) -> None:
        """Compile or load the kernel of a structure, and its tangents where they are wanted.

        `make` : what has the lanes, as `Bundle` has eight.
        """
        point = int(np.flatnonzero(study.structure == structure)[0])
        kernel = ready_kernel(study.point_scene(point), study.job["formulation"], study.method)
        tangents = compile_tangents(kernel) if study.carries_exponents else None
        self.study = study
        self.structure = structure
        keep_steps = lanes_that_keep_steps(study)
        watch = bool(study.channels)
        self.bundle = make(kernel, watch=watch, tangents=tangents, keep_steps=keep_steps)
        self.recording = Recording(study, self.bundle)
        self.lanes: list[PointRun | None] = [None] * len(self.bundle.runs)
        self._ready: dict[int, tuple[ReadyLanes, int]] = {}
        self._refused: list[PointEnd] = []
        """Points that cannot start as they say."""

    @property
    def busy(self) -> bool:
        """Whether a lane computes a point."""
        return any(run is not None for run in self.lanes)

    @property
    def steps(self) -> float:
        """Accepted steps of the points under way."""
        busy = (self.bundle.lane(i) for i, run in enumerate(self.lanes) if run is not None)
        return float(sum(lane.steps for lane in busy))

    def under_way(self) -> float:
        """Return how many points the parts of those under way amount to."""
        return sum(
            (len(run.tried) + self._computed(lane, run)) / self.study.starts
            for lane, run in enumerate(self.lanes)
            if run is not None
        )

    def _computed(self, lane: int, run: PointRun) -> float:
        """Return how much of a point is computed, 0..1, counted in steps of its record."""
        study, at = self.study, self.bundle.lane(lane)
        whole, stretch = float(study.duration[run.point]), 0.0
        if study.carries_exponents:
            stretch = COST * periods_of(study.record) * float(study.period[run.point])
        if run.ended is None:
            return min(at.time, whole) / (whole + stretch)
        return max(1.0 - COST * (float(at.run["duration"]) - at.time) / (whole + stretch), 0.0)

    def fill(self, waiting: list[PointRun]) -> tuple[int, ...]:
        """Give free lanes waiting points of this structure. Returns those points."""
        started = []
        for lane, computed in enumerate(self.lanes):
            if computed is not None:
                continue
            run = self._next(waiting)
            if run is None:
                break
            self._load(lane, run, waiting)
            waiting.remove(run)
            self.lanes[lane] = run
            started.append(run.point)
        return tuple(started)

    def _next(self, waiting: list[PointRun]) -> PointRun | None:
        """Return the first that fits; those before it that cannot start end here."""
        for run in [one for one in waiting if self.study.structure[one.point] == self.structure]:
            end = end_of_start(self.study, run.point) if run.start is None else None
            if end is None:
                return run
            waiting.remove(run)
            waiting += self._next_of_chain(run, None)
            self._refused.append(end)
        return None

    def _load(self, lane: int, run: PointRun, waiting: list[PointRun]) -> None:
        """Give a free lane a waiting point; those that wait beside it are made ready together."""
        study, kernel, point = self.study, self.bundle.kernel, run.point
        if run.lane is not None:
            self.bundle.take_up(lane, *run.lane)
            run.lane = None
            return
        begin_point(study, kernel, run)
        if run.start is not None:
            scene = study.point_scene(point)
            self.bundle.load(lane, problem_of(study, kernel, point, scene, run.start))
            return
        if point not in self._ready:
            alike = (
                one.point
                for one in waiting
                if study.structure[one.point] == self.structure
                and one.start is None
                and one.lane is None
            )
            points = list(islice(alike, AT_ONCE))
            lanes = ready(study, kernel, self.bundle.tangents, points)
            self._ready = {one: (lanes, k) for k, one in enumerate(points)}
        self.bundle.load_ready(lane, *self._ready.pop(point))

    def collect(self) -> Collected:
        """Take the rows of all lanes and free those whose points are over."""
        sections: list[SectionRows] = []
        ended, self._refused = self._refused, []
        following: list[PointRun] = []
        for lane, run in enumerate(self.lanes):
            if run is None:
                continue
            status = self.bundle.lane(lane).status
            if run.ended is None:
                sections += self.recording.take(lane, run)
            else:
                run.finer.append(self.bundle.growth(lane))
            if status == Status.RUNNING or self._goes_on(lane, run, status, following):
                continue
            end = judged(self.study, self.bundle.kernel, run)
            again = from_next_start(self.study, self.bundle.kernel, run, end)
            if again is None:
                ended.append(of_all_starts(self.study, run, end))
            else:
                following.append(again)
            self.lanes[lane] = None
        return sections, ended, following

    def _goes_on(self, lane: int, run: PointRun, status: Status, following: list[PointRun]) -> bool:
        """Give a lane that has stopped the next part of its point.

        Returns whether there was one.
        """
        at = self.study, self.bundle, lane, run
        if run.ended is not None:
            return status == Status.DONE and looks_longer(*at)
        if status == Status.DONE and goes_on(*at):
            return True
        run.ended = self.recording.end(lane, run, status)
        following += self._following(lane, run, run.ended)
        return looks_again(*at)

    def _following(self, lane: int, run: PointRun, end: PointEnd) -> Iterator[PointRun]:
        """Yield the next point of a chain, which starts where this one came to."""
        yield from self._next_of_chain(run, None if end.code else self.bundle.state_of(lane))

    def _next_of_chain(self, run: PointRun, start: LaneStart | None) -> Iterator[PointRun]:
        """Yield the next point of a chain; without a start it begins as its scene says."""
        order, position = self.study.chain_order[run.chain], run.position + 1
        if position < len(order):
            yield PointRun(order[position], run.chain, position, start)
