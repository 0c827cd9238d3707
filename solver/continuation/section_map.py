"""The map from one section of a driven mechanism to that some periods later, and its derivatives.

Derivatives are central differences of lanes side by side. Tangents follow the steps of the motion
with a method of order three: through a hard impact they err by 3e-4 at tolerance 1e-11, differences
by 1e-8. Differences cost as much, pass contact laws that jump, and go over the parameter, too.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import LaneProblem, LaneStart
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
COARSER = 4.0
"""The second scale of differences, in the first."""


@dataclass(frozen=True)
class Section:
    """A value of the parameter, and the state at a section.

    `state` is (states + pairs,): coordinates, speeds and inner states, then the latched impact rate
    of each pair, m/s: 0 where the pair is apart.
    """

    value: float
    state: Floats

    def moved(self, value: float, state: Floats) -> "Section":
        """Return the section farther by a difference of each."""
        return Section(self.value + value, self.state + state)


@dataclass(frozen=True)
class Passage:
    """A run from a section to the one some periods later."""

    end: Floats
    """State there, as that of a `Section`."""
    onsets: int
    """Beginnings of contact."""
    steps: int
    """Accepted."""
    failure: str
    """Why the run did not come to its end, as a sentence; empty if it did."""


@dataclass(frozen=True)
class Linear:
    """The map at a section, and its derivatives."""

    passage: Passage
    residual: Floats
    """(size,) the end less the start; 0 for a pair whose contact lasts throughout."""
    jacobian: Floats
    """(size, size) of the end by the start; no row for a pair whose contact lasts throughout."""
    sensitivity: Floats
    """(size,) of the end by the parameter."""
    alike: bool
    """Whether the runs beside have as many onsets: else an impact begins or ends here."""


@dataclass(frozen=True)
class SectionMap:
    """The map of a mechanism one parameter of which varies."""

    kernel: Kernel
    scene_at: Callable[[float], Scene]
    periods: int
    """Periods of the drivers that it lasts."""
    tolerance: float
    scales: Floats
    """(size,) of the states and impact rates."""
    width: float
    """Scale of the parameter."""
    looked: Callable[[], None] = lambda: None
    """Called after every look at the lanes."""
    recall: Callable[[Callable[[], Answers]], Answers] = lambda compute: compute()
    """Returns what `compute` does, or did before at the same place of the same continuation."""
    steps: float = math.inf
    """Accepted steps in a period of the motion that the branch begins with."""

    @property
    def size(self) -> int:
        """Numbers of a section."""
        return self.kernel.states + len(self.kernel.pairs)

    def linear(self, section: Section, scale: float = 1.0) -> Linear:
        """Return the map at a section and its derivatives; of use only without a failure.

        `scale` : of the differences, in the usual ones.
        """
        states = self.kernel.states
        touching = section.state[states:] > 0.0
        columns = [*range(states), *(states + np.flatnonzero(touching)).tolist()]
        steps = np.eye(self.size)[columns] * (scale * DIFFERENCE * self.scales[columns])[:, None]
        beside = [(sign * scale * DIFFERENCE * self.width, np.zeros(self.size)) for sign in (1, -1)]
        beside += [(0.0, sign * step) for step in steps for sign in (1, -1)]
        base, *others = self.passages([section, *(section.moved(*one) for one in beside)])
        failed = next((one for one in others if one.failure), None)
        if failed is not None and not base.failure:
            base = replace(base, failure=failed.failure)
        rates = zip(others[::2], others[1::2], strict=True)
        (along, *differences) = [(up.end - down.end) / 2.0 for up, down in rates]
        jacobian = np.zeros((self.size, self.size))
        for column, step, difference in zip(columns, steps, differences, strict=True):
            jacobian[:, column] = difference / step[column]
        residual, sensitivity = base.end - section.state, along / (scale * DIFFERENCE * self.width)
        lasting = states + np.flatnonzero(touching & (residual[states:] == 0.0))
        jacobian[lasting] = 0.0
        sensitivity[lasting] = 0.0
        alike = all(one.onsets == base.onsets for one in others)
        return Linear(base, residual, jacobian, sensitivity, alike)

    def passages(self, sections: Sequence[Section]) -> list[Passage]:
        """Return the runs from sections, eight lanes side by side."""

        def compute() -> Answers:
            numbers, failures = [np.zeros((0, self.size + 2))], list[str]()
            for first in range(0, len(sections), BUNDLE):
                part, failed = self._bundle(sections[first : first + BUNDLE])
                numbers.append(part)
                failures += failed
            return np.concatenate(numbers), failures

        return [
            Passage(row[:-2], int(row[-2]), int(row[-1]), failure)
            for row, failure in zip(*self.recall(compute), strict=True)
        ]

    def _bundle(self, sections: Sequence[Section]) -> Answers:
        bundle = Bundle(self.kernel, watch=False)
        scenes: list[Scene] = []
        for lane, section in enumerate(sections):
            values = [one.value for one in sections[:lane]]
            like = values.index(section.value) if section.value in values else None
            scenes.append(self.scene_at(section.value) if like is None else scenes[like])
            bundle.load(lane, self._problem(scenes[lane], section), like)
        attempts, most = 0, SLOWEST * self.steps * self.periods + SPARE
        while bundle.advance(ATTEMPTS) and attempts < most:
            attempts += ATTEMPTS
            self.looked()
        self.looked()
        numbers, failures = np.empty((len(sections), self.size + 2)), list[str]()
        for lane, scene in enumerate(scenes):
            at = bundle.lane(lane)
            if at.status == Status.RUNNING:
                failures.append(f"a run beside it takes more than {most:.2g} steps")
            elif at.status == Status.DONE:
                failures.append("")
            else:
                failures.append(failure_of(bundle, lane, self.tolerance, scene).detail)
            numbers[lane, : self.kernel.states] = at["y"]
            numbers[lane, self.kernel.states : -2] = at["impact_rate"] * at["mode"]
            numbers[lane, -2:] = at.run["onsets"], at.steps
        return numbers, failures

    def _problem(self, scene: Scene, section: Section) -> LaneProblem:
        start = LaneStart.at_section(section.state, self.kernel.states)
        duration = self.periods * (common_period(scene).seconds or math.nan)
        return LaneProblem(scene, duration, self.tolerance, duration, 0, 0, 0.0, start=start)
