"""Measured values of candidates in one case: each is a run, in a lane of a kernel.

Lanes do not touch each other, so what a candidate gives depends on nothing but the candidate.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.failure import Problem
from jointplay.records.peak import Peak
from jointplay.solver.calibration.problem import Calibration, CheckedCase
from jointplay.solver.calibration.windows import Windows
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.start.states import start_state
from jointplay.solver.runs.lane_results import peaks_of
from jointplay.solver.runs.study.fields import geometry_columns, structure_columns
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.scene.document import Scene

BUDGET = 20_000
"""Attempted steps between two looks at the lanes."""
MOVING = ("/drivers/", "/start/")
"""Parts of a scene, beside its geometry, that decide how it starts."""


Looked = Callable[[int, int], None]
"""Called after each look at the lanes: with the runs that ended, and their accepted steps."""


@dataclass(eq=False)
class _Run:
    """A candidate in a case, in its lane."""

    row: int
    scene: Scene
    columns: Integers
    """Rows of the kernel's channel block that are read off the grid."""
    stops: int = 0
    """That it has come to."""
    legs: list[dict[str, Peak]] = field(default_factory=list)
    samples: list[Floats] = field(default_factory=list)


class CaseMeasure:
    """Measures candidates in one case."""

    def __init__(
        self, calibration: Calibration, case: CheckedCase, chosen: list[int], looked: Looked
    ) -> None:
        """Look only at the chosen targets, by their index in the case."""
        self.looked = looked
        self.case = case
        self.chosen = chosen
        self.windows = Windows([case.targets[index] for index in chosen])
        self.tolerance = calibration.tolerance
        self.most_steps = calibration.search.most_steps
        self.formulation = str(calibration.document["formulation"])
        self.scenes = case.study.scenes
        self.same_start = not list(geometry_columns(self.scenes)) and not any(
            leaf.path.startswith(MOVING) for leaf in self.scenes.leaves
        )
        """Whether all candidates start alike."""
        self._bundles: dict[tuple[int, ...], Bundle] = {}
        self._starts: dict[tuple[int, ...], LaneStart] = {}

    def prepare(self) -> list[Problem]:
        """Compile what the first candidates need. Returns targets that cannot be measured."""
        scene = self.case.study.point_scene(0)
        rows = self._kernel(_forms(self.scenes)[0], scene).rows
        return [
            Problem(
                f"/targets/{index}/channel",
                f"'{target.channel}' follows from the drivers alone: no extreme of it is sought"
                " in a window of time. Choose a channel that the motion decides.",
            )
            for index, target in zip(self.chosen, self.windows.targets, strict=True)
            if target.channel not in rows.watched and target.channel not in rows.multiples
        ]

    def __call__(self, candidates: Floats) -> Floats:
        """Return the values of the chosen targets (n, chosen); NaN where a run failed."""
        out = np.full((len(candidates), len(self.chosen)), np.nan)
        scenes = PointScenes(self.scenes.base, self.scenes.leaves, candidates)
        groups: dict[tuple[int, ...], list[int]] = {}
        for row, form in enumerate(_forms(scenes)):
            groups.setdefault(form, []).append(row)
        for form, rows in groups.items():
            kernel = self._kernel(form, scenes.scene(rows[0]))
            columns = np.array([kernel.rows.index(n) for n in self.windows.read], np.int64)
            runs = (_Run(row, scenes.scene(row), columns) for row in rows)
            for run in self._computed(self._bundles[form], form, runs):
                out[run.row] = self.windows.values(run.legs, _stacked(run, len(columns)))
        return out

    def _kernel(self, form: tuple[int, ...], scene: Scene) -> Kernel:
        if form not in self._bundles:
            kernel = ready_kernel(scene, self.formulation, self.case.study.method)
            self._bundles[form] = Bundle(kernel, watch=bool(self.windows.watched))
        return self._bundles[form].kernel

    def _computed(
        self, bundle: Bundle, form: tuple[int, ...], runs: Iterable[_Run]
    ) -> Iterator[_Run]:
        """Yield the runs that came to their end, in the order in which they did."""
        waiting = deque(runs)
        lanes: list[_Run | None] = [None] * BUNDLE
        while waiting or any(lanes):
            for lane in range(BUNDLE):
                if lanes[lane] is None and waiting:
                    begun = lanes[lane] = waiting.popleft()
                    bundle.load(lane, self._problem(bundle.kernel, form, begun.scene))
            bundle.advance(BUDGET)
            ended = steps = 0
            for lane, run in enumerate(lanes):
                if run is None:
                    continue
                self._read(bundle, lane, run)
                at = bundle.lane(lane)
                costly = at.attempts > self.most_steps
                if at.running:
                    if not costly:
                        continue
                    at.end(Status.STEP_LIMIT)
                elif at.status == Status.DONE and not costly:
                    if self._goes_on(bundle, lane, run):
                        continue
                    yield run
                lanes[lane] = None
                ended, steps = ended + 1, steps + at.steps
            self.looked(ended, steps)

    def _goes_on(self, bundle: Bundle, lane: int, run: _Run) -> bool:
        """Take what a leg gave, at its end. Returns whether there was a next stop to go to."""
        run.stops += 1
        ended = run.stops % 2 == 0
        if ended:
            run.legs.append(peaks_of(bundle, lane, self.windows.watched))
        if run.stops == len(self.windows.stops):
            return False
        bundle.extend(lane, run.scene, self.windows.stops[run.stops], 0, forget=ended)
        return True

    def _problem(self, kernel: Kernel, form: tuple[int, ...], scene: Scene) -> LaneProblem:
        windows = self.windows
        return LaneProblem(
            scene,
            windows.stops[0],
            self.tolerance,
            windows.step or windows.legs[-1],
            windows.samples,
            0,
            0.0,
            start=self._start(kernel, form, scene),
        )

    def _start(self, kernel: Kernel, form: tuple[int, ...], scene: Scene) -> LaneStart:
        """Return the scene's own start, from the same assembly as long as geometry stays."""
        if form in self._starts:
            return self._starts[form]
        assembly = assemble(scene)
        state = start_state(scene, kernel.coordinates, assembly.pose, assembly.velocity)
        start = LaneStart(state)
        if self.same_start:
            self._starts[form] = start
        return start

    def _read(self, bundle: Bundle, lane: int, run: _Run) -> None:
        """Observe the samples that a lane has handed out."""
        rows = bundle.rows(SAMPLES, lane)
        if len(rows) and len(run.columns):
            run.samples.append(bundle.observe(lane, rows, run.columns))


def _forms(scenes: PointScenes) -> list[tuple[int, ...]]:
    """Return what tells the structure of each candidate within its case."""
    columns = list(structure_columns(scenes))
    if not columns:
        return [()] * len(scenes.values)
    return [tuple(row) for row in np.stack(columns, axis=1).tolist()]


def _stacked(run: _Run, columns: int) -> Floats:
    return np.concatenate(run.samples) if run.samples else np.empty((0, columns))
