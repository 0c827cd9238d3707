"""Maps in closed form in place of runs: where their fixed points bifurcate is known exactly."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row, follow
from jointplay.solver.continuation.orbit import Curve, Scales
from jointplay.solver.continuation.plan import Reach
from jointplay.solver.continuation.section_map import Passage, Section, SectionMap
from jointplay.solver.continuation.start import first_orbit

Formula = Callable[[Floats, float], Sequence[float]]


@dataclass(frozen=True)
class KnownMap(SectionMap):
    """A section map that is a formula of state and parameter."""

    formula: Formula = lambda state, _value: state.tolist()
    impacts: Callable[[Floats, float], int] = lambda _state, _value: 0

    def passages(self, sections: Sequence[Section]) -> list[Passage]:
        """Return what the formula gives, iterated for each period."""
        found = []
        for one in sections:
            end = one.state
            for _ in range(self.periods):
                end = np.array(self.formula(end, one.value), np.float64)
            onsets = self.impacts(one.state, one.value)
            found.append(Passage(end, onsets, 1, ""))
        return found


def rows_of(
    formula: Formula,
    start: Sequence[float],
    values: tuple[float, float],
    *,
    impacts: Callable[[Floats, float], int] = lambda _state, _value: 0,
    step: float = 0.03,
    low: float | None = None,
    orbits: int = 400,
    sense: float = 1.0,
) -> list[Row]:
    """Return the branch of fixed points from a state, from one value of the parameter to another.

    `low` : the other end of the range; else the value at which the branch begins.
    """
    size, (begin, end) = len(start), values
    kernel: Any = SimpleNamespace(states=size, pairs=())  # all that is asked of one
    width = abs(end - begin)
    ones = np.ones(size)
    map_ = KnownMap(
        kernel, lambda _value: None, 1, 1e-13, ones, width, formula=formula, impacts=impacts
    )  # type: ignore[arg-type,return-value]
    curve = Curve(map_, Scales(np.append(ones, width), np.append(ones / size, 1.0)))
    orbit = first_orbit(curve, Section(begin, np.array(start, np.float64)))
    way = np.append(np.zeros(size), np.sign(end - begin))
    ends = sorted((begin if low is None else low, end))
    return list(follow(orbit, way, Reach(ends[0], ends[1], orbits, step), sense))
