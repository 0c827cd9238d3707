"""The map from one section of a mechanism to that some periods later, and its derivatives.

Derivatives are central differences of lanes side by side. Tangents follow the steps of the motion
with a method of order three: through a hard impact they err by 3e-4 at tolerance 1e-11, differences
by 1e-8. Differences cost as much, pass contact laws that jump, and go over the parameter, too.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.passage import Linear, Passage, Section
from jointplay.solver.continuation.section_runs import SectionRuns

DIFFERENCE = 1e-5
"""Differences of states and of the parameter, in the scale of each."""
OF_RATE = 1e-3
"""Difference of a latched impact rate, in that rate, at most: damping goes by its inverse."""
TURN = 2.0 * math.pi
COARSER = 4.0
"""The second scale of differences, in the first."""


@dataclass(frozen=True)
class SectionMap(SectionRuns):
    """The map of a mechanism one parameter of which varies."""

    scales: Floats
    """(size,) of the states and impact rates."""
    width: float
    """Scale of the parameter."""
    _: KW_ONLY
    second_width: float = 1.0
    """Scale of the second parameter."""
    has_friction: bool = False
    """Whether there are slips whose phases may change along a branch."""
    angles: tuple[int, ...] = ()
    """States that are back after a whole turn."""
    cyclic: tuple[int, ...] = ()
    """States, coordinates, on which nothing depends: they are back wherever they are."""

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

    def away(self, end: Floats, start: Floats) -> Floats:
        """Return (size,) how far the end of a run is from its start, states of sections.

        Without whole turns, and along cyclic coordinates not at all.
        """
        found, angles = end - start, list(self.angles)
        found[angles] -= TURN * np.round(found[angles] / TURN)
        found[list(self.cyclic)] = 0.0
        return found

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

    def _steps(self, section: Section, scale: float) -> Floats:
        """Return (size,) by how much the numbers of a section differ beside it."""
        steps, states = DIFFERENCE * self.scales, self.kernel.states
        rates = section.state[states:]
        slow = np.where(rates > 0.0, OF_RATE * rates, np.inf)
        steps[states:] = np.minimum(steps[states:], slow)
        return scale * steps

    def _beside(self, section: Section, scale: float, over: int) -> Iterator[Section]:
        """Yield the sections beside one: both sides of each value, then of each number."""
        zero = np.zeros(self.size)
        for values in scale * DIFFERENCE * np.diag(self.widths[:over]):
            yield from (section.moved(zero, *(sign * values)) for sign in (1.0, -1.0))
        steps = self._steps(section, scale)
        for column in self._columns(section):
            step = zero.copy()
            step[column] = steps[column]
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
        widths = scale * DIFFERENCE * self.widths[:over]
        steps = np.append(self._steps(section, scale), widths)
        for column, rate in zip(columns, rates, strict=True):
            whole[:, column] = rate / steps[column]
        jacobian, sensitivity, nearing = whole[:-1, : self.size], whole[:-1, self.size :], whole[-1]
        residual, states = self.away(base.end, section.state), self.kernel.states
        touching = section.state[states:] > 0.0
        lasting = states + np.flatnonzero(touching & (residual[states:] == 0.0))
        kept = [*lasting.tolist(), *self.cyclic]
        jacobian[kept] = 0.0
        sensitivity[kept] = 0.0
        alike = all(one.onsets == base.onsets for one in others)
        return Linear(base, residual, jacobian, sensitivity, alike, jacobian, nearing)
