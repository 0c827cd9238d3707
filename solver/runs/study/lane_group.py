"""The lanes that compute points of one structure, side by side: seed, settle, record, judge."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from itertools import islice

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import RUNNING, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.ready_lanes import ReadyLanes
from jointplay.solver.runs.study.held_starts import end_of_start
from jointplay.solver.runs.study.judge import judged, looks_again, looks_longer
from jointplay.solver.runs.study.neighbour import neighbours_start
from jointplay.solver.runs.study.part_computed import part_computed
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_extremes import lanes_that_keep_steps
from jointplay.solver.runs.study.point_news import PointNews
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.problem import begin_point, problem_of, ready
from jointplay.solver.runs.study.record import Recording
from jointplay.solver.runs.study.settle import goes_on
from jointplay.solver.runs.study.several_starts import from_next_start, of_all_starts

AT_ONCE = 64
"""Points that are made ready together."""

FREE = -1
"""Block of a lane that computes no point."""
HANDED = ("growths", "kept")
"""Fields of a run that say what a lane has handed out, beside rows and contacts."""

Make = Callable[..., Bundle]


class LaneGroup:
    """A kernel's lanes, each with the point that it computes, of one of several blocks, or free."""

    def __init__(self, study: Study, structure: int, make: Make) -> None:
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
        self._blocks = np.full(len(self.lanes), FREE)
        """(lanes,) block that the point of each is of."""
        self._ready: dict[int, tuple[ReadyLanes, int]] = {}
        self._news: defaultdict[int, PointNews] = defaultdict(PointNews)
        """By block, since it was last collected."""

    @property
    def free(self) -> int:
        """Number of lanes that compute no point."""
        return int(np.count_nonzero(self._blocks == FREE))

    @property
    def busy(self) -> bool:
        """Whether a lane computes a point."""
        return self.free < len(self.lanes)

    def computes(self, block: int) -> bool:
        """Return whether a lane computes a point of a block."""
        return bool((self._blocks == block).any())

    def runs_of(self, block: int) -> dict[int, PointRun]:
        """Return the points of a block that are under way, by their lanes."""
        lanes = np.flatnonzero(self._blocks == block).tolist()
        return {lane: run for lane in lanes if (run := self.lanes[lane]) is not None}

    def under_way(self, block: int) -> float:
        """Return how many points the parts of a block's under way amount to."""
        runs = self.runs_of(block)
        now, until = self.bundle.now(), self.bundle.runs["duration"]
        return part_computed(self.study, [*runs.values()], now[[*runs]], until[[*runs]])

    def fill(self, waiting: list[PointRun], block: int = 0) -> tuple[int, ...]:
        """Give free lanes waiting points of a block, of this structure. Returns those points."""
        started: list[int] = []
        for lane in np.flatnonzero(self._blocks == FREE).tolist() if waiting else ():
            run = self._next(waiting, block)
            if run is None:
                break
            self._load(lane, run, waiting)
            waiting.remove(run)
            self.lanes[lane], self._blocks[lane] = run, block
            started.append(run.point)
        return tuple(started)

    def _next(self, waiting: list[PointRun], block: int) -> PointRun | None:
        """Return the first that fits; those before it that cannot start end here."""
        for run in list(waiting):
            if self.study.structure[run.point] != self.structure:
                continue
            end = end_of_start(self.study, run.point) if run.start is None else None
            if end is None:
                return run
            waiting.remove(run)
            waiting += self._next_of_chain(run, None)
            self._news[block].ended.append(end)
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

    def drop(self, block: int) -> None:
        """Free the lanes that compute points of a block; what they had come to is lost."""
        for lane in self.runs_of(block):
            self.bundle.stop(lane)
            self.lanes[lane], self._blocks[lane] = None, FREE
        self._news.pop(block, None)

    def collect(self) -> Mapping[int, PointNews]:
        """Take what lanes have handed out, and free those whose points are over.

        Returns what is new, by block.
        """
        news, self._news = self._news, defaultdict(PointNews)
        for lane in np.flatnonzero(self._has_news()).tolist():
            run = self.lanes[lane]
            if run is not None:
                self._take(lane, run, news[int(self._blocks[lane])])
        return news

    def _has_news(self) -> Flags:
        """Return (lanes,) of which there is something to take: few, of the many of a device."""
        runs = self.bundle.runs
        handed = [*HANDED, "impacts"] if self.study.statistics else HANDED
        counts = runs["filled"].sum(axis=1) + sum(runs[name] for name in handed)
        found: Flags = (runs["status"] != RUNNING) | (counts > 0)
        return found

    def _take(self, lane: int, run: PointRun, news: PointNews) -> None:
        """Take what a lane has handed out, and free it if its point is over."""
        status = self.bundle.lane(lane).status
        if run.ended is None:
            news.rows += self.recording.take(lane, run)
        else:
            run.finer.append(self.bundle.growth(lane))
        if status == RUNNING or self._goes_on(lane, run, status, news.following):
            return
        end = judged(self.study, self.bundle.kernel, run)
        again = from_next_start(self.study, self.bundle.kernel, run, end)
        if again is None:
            news.ended.append(of_all_starts(self.study, run, end))
        else:
            news.following.append(again)
        self.lanes[lane], self._blocks[lane] = None, FREE

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
        following += self._next_of_chain(run, None if run.ended.code else lane)
        return looks_again(*at)

    def _next_of_chain(self, run: PointRun, lane: int | None) -> Iterator[PointRun]:
        """Yield the next point of a chain, which starts where a lane is, or as its scene says."""
        order, position = self.study.chain_order[run.chain], run.position + 1
        if position < len(order):
            point = order[position]
            there = None if lane is None else neighbours_start(self.study, self.bundle, lane, point)
            yield PointRun(point, run.chain, position, there)
