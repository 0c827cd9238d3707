"""Runs of a mechanism from sections to those some periods later, eight lanes side by side.

Of a mechanism that nothing drives periods are those from one crossing to the next.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.solver.continuation.closest_approach import (
    NO_MARGINS,
    Approaches,
    Margins,
    fine_rows_of,
    rows_of,
)
from jointplay.solver.continuation.crossing import PATIENCE, Crossing, Crossings
from jointplay.solver.continuation.passage import Passage, Section
from jointplay.solver.continuation.slips import Slips
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import Event, LaneProblem, LaneStart
from jointplay.solver.runs.lane_results import failure_of
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import common_period

Answers = tuple[Floats, list[str]]
"""Numbers, a row each run, and why each failed, if it did."""

ATTEMPTS = 20_000
"""Attempts at steps between two looks at the lanes."""
SLOWEST, SPARE = 30.0, 10 * ATTEMPTS
"""Steps of a run at most, in those of the motion that a branch begins with, and besides: a run that
Newton's method asks for may begin deep in a contact, and then take for ever."""
TOLD = 8
"""Numbers of a run beside its end: margins, how near it comes to another impact, s, by how much
closing loops moved its start, onsets, steps."""


@dataclass(frozen=True)
class SectionRuns:
    """Runs of a mechanism whose parameter varies, from one section to another."""

    kernel: Kernel
    scene_at: Callable[..., Scene]
    """By the values of a section."""
    periods: int
    """Periods of the drivers that they last, or crossings to the last one."""
    tolerance: float
    _: KW_ONLY
    looked: Callable[[], None] = lambda: None
    """Called after every look at the lanes."""
    recall: Callable[[Callable[[], Answers]], Answers] = lambda compute: compute()
    """Returns what `compute` does, or did before at the same place of the same continuation."""
    watches: bool = False
    """Whether runs tell how near they come to another impact."""
    tells: bool = False
    """Whether the first of runs side by side tells margins and phases of friction; not beside
    `watches`."""
    steps: float = math.inf
    """Accepted steps in a period of the motion that the branch begins with."""
    crossing: Crossing | None = None
    """Makes sections; none: they are at crank angle 0."""
    back_after: int = 1
    """Periods after which wheels behind gears are back: sections in between are others."""

    @property
    def size(self) -> int:
        """Numbers of a section."""
        return self.kernel.states + len(self.kernel.pairs)

    def interval(self, scene: Scene) -> float:
        """Return the time of one period, s."""
        if self.crossing is not None:
            return self.crossing.interval
        return common_period(scene).seconds or math.nan

    def numbers_at(self, row: Floats) -> Floats:
        """Return (size,) the state of a section at a dense row, (width,)."""
        at = self.kernel.row
        latched = row[at.impact_rate : at.width] * row[at.mode : at.impact_rate]
        return np.concatenate([at.states(row), latched])

    def observed(self, section: Section, rows: Integers) -> Floats:
        """Return (rows,) channels at a section, by their indices in the kernel's block."""
        scene, bundle = self.scene_at(*section.values), Bundle(self.kernel, watch=False)
        bundle.load(0, self._problem(scene, section, self.interval(scene)))
        return np.asarray(bundle.observe(0, bundle.lane(0).row(), rows)[0])

    def passages(self, sections: Sequence[Section]) -> list[Passage]:
        """Return the runs from sections, eight lanes side by side."""

        def compute() -> Answers:
            numbers, failures = list[Floats](), list[str]()
            for first in range(0, len(sections), BUNDLE):
                part, failed = self._bundle(sections[first : first + BUNDLE])
                numbers.append(part)
                failures += failed
            return np.concatenate(numbers), failures

        found = list[Passage]()
        for row, failure in zip(*self.recall(compute), strict=True):
            *margins, near, duration, moved, onsets, steps = row[-TOLD:].tolist()
            phases = tuple(map(int, row[self.size : -TOLD]))
            told = int(onsets), int(steps), failure, near, duration, Margins(*margins), phases
            found.append(Passage(row[: self.size], *told, moved))
        return found

    def _bundle(self, sections: Sequence[Section]) -> Answers:
        scenes = [self.scene_at(*one.values) for one in sections]
        durations = [self.periods * self.interval(scene) for scene in scenes]
        steps, failures = np.zeros(len(sections)), [""] * len(sections)
        if self.crossing is not None:
            # inside a step a state is known less well than at its end: runs end there once more
            event = self.crossing.behind()
            found = self._run(sections, scenes, [PATIENCE * one for one in durations], event)
            durations = [found.crossings.time(lane, self.periods) for lane in range(len(scenes))]
            steps, failures = found.steps, found.failures
        ended = self._run(sections, scenes, durations)
        failures = [one or other for one, other in zip(failures, ended.failures, strict=True)]
        phases = [] if ended.slips is None else ended.slips.phases()
        numbers = np.empty((len(sections), self.size + len(phases) + TOLD))
        for lane, duration in enumerate(durations):
            at = ended.bundle.lane(lane)
            interval = float(at.run["output_step"])
            near, margins = math.nan, NO_MARGINS
            if self.watches:
                near = ended.approaches.nearest(lane, interval)
                margins = Margins(speed=ended.approaches.slowest(lane))
            elif self._rows(lane) and not failures[lane]:
                margins = ended.approaches.margins(lane, interval)
            counts = at.run["onsets"], ended.steps[lane] + steps[lane]
            told = *margins, near, duration, ended.moved[lane], *counts
            numbers[lane] = np.concatenate([self.numbers_at(at.row()[0]), phases, told])
        return numbers, failures

    def _run(
        self,
        sections: Sequence[Section],
        scenes: Sequence[Scene],
        durations: Sequence[float],
        event: Event | None = None,
    ) -> "_Runs":
        """Return runs from sections, side by side, over times (s) or to events before that."""
        bundle, moved = Bundle(self.kernel, watch=False), list[float]()
        for lane, section in enumerate(sections):
            values = [one.values for one in sections[:lane]]
            like = values.index(section.values) if section.values in values else None
            rows = self._rows(lane) if event is None else 0
            problem = self._problem(scenes[lane], section, durations[lane], event, rows)
            bundle.load(lane, problem, like)
            closed = bundle.lane(lane)["y"] - section.state[: self.kernel.states]
            moved.append(float(np.abs(closed).max()))
        attempts, most = 0, SLOWEST * self.steps * self.periods + SPARE
        watched = sum(self._rows(lane) > 0 for lane in range(len(sections)))
        approaches = Approaches(bundle, watched if event is None else 0)
        crossings = Crossings(bundle, 0 if event is None else len(sections))
        slips = Slips(bundle, scenes[0]) if self.tells and event is None else None
        running = 1
        while running and attempts < most:
            running = bundle.advance(ATTEMPTS)
            approaches.collect()
            crossings.collect()
            if slips is not None:
                slips.collect()
            attempts += ATTEMPTS
            self.looked()
        failures = list[str]()
        for lane, scene in enumerate(scenes):
            at = bundle.lane(lane)
            if at.status == Status.RUNNING:
                failures.append(f"a run beside it takes more than {most:.2g} steps")
            elif at.status == Status.DONE:
                failures.append("" if event is None else crossings.lack(lane, self.periods))
            else:
                failures.append(failure_of(bundle, lane, self.tolerance, scene).detail)
        return _Runs(bundle, approaches, crossings, slips, failures, moved)

    def _rows(self, lane: int) -> int:
        """Return how many rows a run hands out, by its lane."""
        if self.watches:
            return rows_of(self.periods)
        return fine_rows_of(self.periods) if self.tells and lane == 0 else 0

    def _problem(
        self,
        scene: Scene,
        section: Section,
        duration: float,
        event: Event | None = None,
        rows: int = 0,
    ) -> LaneProblem:
        start = LaneStart.at_section(section.state, self.kernel.states)
        return LaneProblem(
            scene,
            duration,
            self.tolerance,
            duration / max(rows, 1),
            rows + (rows > 0),
            0 if event is None else self.periods,
            0.0,
            event=event,
            start=start,
            ledger=False,
        )


@dataclass(frozen=True)
class _Runs:
    """Runs side by side, as far as they came."""

    bundle: Bundle
    approaches: Approaches
    crossings: Crossings
    slips: Slips | None
    failures: list[str]
    moved: list[float]
    """By how much closing loops moved each start, in the unit of what moved most."""

    @property
    def steps(self) -> Floats:
        """Accepted steps of each run."""
        return np.array([float(self.bundle.lane(k).steps) for k in range(len(self.failures))])
