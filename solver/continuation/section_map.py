"""The map from one section of a mechanism to that some periods later, and its derivatives.

Of a mechanism that nothing drives periods are those from one crossing to the next.

Derivatives are central differences of lanes side by side. Tangents follow the steps of the motion
with a method of order three: through a hard impact they err by 3e-4 at tolerance 1e-11, differences
by 1e-8. Differences cost as much, pass contact laws that jump, and go over the parameter, too.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

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
from jointplay.solver.continuation.passage import Linear, Passage, Section
from jointplay.solver.continuation.slips import Slips
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import Event, LaneProblem, LaneStart
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.runs.lane_results import failure_of
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import common_period

Answers = tuple[Floats, list[str]]
"""Numbers, a row each run, and why each failed, if it did."""

ATTEMPTS = 20_000
"""Attempts at steps between two looks at the lanes."""
DIFFERENCE = 1e-5
"""Differences of states and of the parameter, in the scale of each."""
SLOWEST, SPARE = 30.0, 10 * ATTEMPTS
"""Steps of a run at most, in those of the motion that a branch begins with, and besides: a run that
Newton's method asks for may begin deep in a contact, and then take for ever."""
TOLD = 7
"""Numbers of a run beside its end: margins, how near it comes to another impact, s, onsets, steps.
"""
TURN = 2.0 * math.pi
COARSER = 4.0
"""The second scale of differences, in the first."""


@dataclass(frozen=True)
class SectionMap:
    """The map of a mechanism one parameter of which varies."""

    kernel: Kernel
    scene_at: Callable[..., Scene]
    """By the values of a section."""
    periods: int
    """Periods of the drivers that it lasts, or crossings to the last one."""
    tolerance: float
    scales: Floats
    """(size,) of the states and impact rates."""
    width: float
    """Scale of the parameter."""
    looked: Callable[[], None] = lambda: None
    """Called after every look at the lanes."""
    recall: Callable[[Callable[[], Answers]], Answers] = lambda compute: compute()
    """Returns what `compute` does, or did before at the same place of the same continuation."""
    second_width: float = 1.0
    """Scale of the second parameter."""
    watches: bool = False
    """Whether runs tell how near they come to another impact."""
    rubs: bool = False
    """Whether there are slips whose phases may change along a branch."""
    tells: bool = False
    """Whether the first of runs side by side tells margins and phases of friction; not beside
    `watches`."""
    steps: float = math.inf
    """Accepted steps in a period of the motion that the branch begins with."""
    crossing: Crossing | None = None
    """Makes sections; none: they are at crank angle 0."""
    angles: tuple[int, ...] = ()
    """States that are back after a whole turn."""
    cyclic: tuple[int, ...] = ()
    """States, coordinates, on which nothing depends: they are back wherever they are."""

    @property
    def size(self) -> int:
        """Numbers of a section."""
        return self.kernel.states + len(self.kernel.pairs)

    @property
    def widths(self) -> Floats:
        """Scales of a section's values."""
        return np.array([self.width, self.second_width])

    def section(self, numbers: Floats) -> Section:
        """Return the section whose state, and then the parameter, are given."""
        *state, value = numbers.tolist()
        return Section(value, np.array(state))

    def numbers(self, section: Section) -> Floats:
        """Return state and parameter of a section, (size + 1,)."""
        return np.append(section.state, section.values)

    def interval(self, scene: Scene) -> float:
        """Return the time of one period, s."""
        if self.crossing is not None:
            return self.crossing.interval
        return common_period(scene).seconds or math.nan

    def away(self, end: Floats, start: Floats) -> Floats:
        """Return (size,) how far the end of a run is from its start, states of sections.

        Without whole turns, and along cyclic coordinates not at all.
        """
        found, angles = end - start, list(self.angles)
        found[angles] -= TURN * np.round(found[angles] / TURN)
        found[list(self.cyclic)] = 0.0
        return found

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

    def distance(self, linear: Linear) -> float:
        """Return how far a section and its end are apart, in the scales of the states."""
        return float(np.abs(linear.residual / self.scales)[: self.kernel.states].max())

    def linear(self, section: Section, scale: float = 1.0) -> Linear:
        """Return the map at a section and its derivatives; of use only without a failure.

        `scale` : of the differences, in the usual ones.
        """
        (found,) = self.linears([section], scale)
        return found

    def linears(self, sections: Sequence[Section], scale: float, over: int = 1) -> list[Linear]:
        """Return what `linear` does of several sections; their lanes fill bundles together.

        `over` : by how many of a section's values to differentiate.
        """
        asked = [[one, *self._beside(one, scale, over)] for one in sections]
        runs = iter(self.passages([one for beside in asked for one in beside]))
        return [
            self._differences(beside[0], [next(runs) for _ in beside], scale, over)
            for beside in asked
        ]

    def _columns(self, section: Section) -> list[int]:
        """Return the numbers of a section by which its end can differ."""
        states = self.kernel.states
        return [*range(states), *(states + np.flatnonzero(section.state[states:] > 0.0)).tolist()]

    def _beside(self, section: Section, scale: float, over: int) -> Iterator[Section]:
        """Yield the sections beside one: both sides of each value, then of each number."""
        zero = np.zeros(self.size)
        for values in scale * DIFFERENCE * np.diag(self.widths[:over]):
            yield from (section.moved(zero, *(sign * values)) for sign in (1.0, -1.0))
        for column in self._columns(section):
            step = zero.copy()
            step[column] = scale * DIFFERENCE * self.scales[column]
            yield from (section.moved(sign * step) for sign in (1.0, -1.0))

    def _differences(
        self, section: Section, runs: Sequence[Passage], scale: float, over: int
    ) -> Linear:
        """Return the map at a section, of the runs from it and from those beside it."""
        base, *others = runs
        failed = next((one for one in others if one.failure), None)
        if failed is not None and not base.failure:
            base = replace(base, failure=failed.failure)
        ends = [np.append(one.end, one.nearest) for one in others]
        rates = [(up - down) / 2.0 for up, down in zip(ends[::2], ends[1::2], strict=True)]
        whole = np.zeros((self.size + 1, self.size + over))
        columns = [*range(self.size, self.size + over), *self._columns(section)]
        numbers = np.append(self.scales, self.widths[:over])
        for column, rate in zip(columns, rates, strict=True):
            whole[:, column] = rate / (scale * DIFFERENCE * numbers[column])
        jacobian, sensitivity, nearing = whole[:-1, : self.size], whole[:-1, self.size :], whole[-1]
        residual, states = self.away(base.end, section.state), self.kernel.states
        touching = section.state[states:] > 0.0
        lasting = states + np.flatnonzero(touching & (residual[states:] == 0.0))
        kept = [*lasting.tolist(), *self.cyclic]
        jacobian[kept] = 0.0
        sensitivity[kept] = 0.0
        alike = all(one.onsets == base.onsets for one in others)
        return Linear(base, residual, jacobian, sensitivity, alike, jacobian, nearing)

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
            *margins, near, duration, onsets, steps = row[-TOLD:].tolist()
            phases = tuple(map(int, row[self.size : -TOLD]))
            told = int(onsets), int(steps), failure, near, duration, Margins(*margins), phases
            found.append(Passage(row[: self.size], *told))
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
            told = *margins, near, duration, at.run["onsets"], ended.steps[lane] + steps[lane]
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
        bundle = Bundle(self.kernel, watch=False)
        for lane, section in enumerate(sections):
            values = [one.values for one in sections[:lane]]
            like = values.index(section.values) if section.values in values else None
            rows = self._rows(lane) if event is None else 0
            problem = self._problem(scenes[lane], section, durations[lane], event, rows)
            bundle.load(lane, problem, like)
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
        return _Runs(bundle, approaches, crossings, slips, failures)

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

    @property
    def steps(self) -> Floats:
        """Accepted steps of each run."""
        return np.array([float(self.bundle.lane(k).steps) for k in range(len(self.failures))])
