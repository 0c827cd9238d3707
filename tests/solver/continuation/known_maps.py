"""Maps in closed form in place of runs: where their fixed points bifurcate is known exactly."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row, follow
from jointplay.solver.continuation.closest_approach import Margins
from jointplay.solver.continuation.orbit import Curve, Scales
from jointplay.solver.continuation.passage import Passage, Section
from jointplay.solver.continuation.plan import Reach
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.continuation.special_curve import special_curve
from jointplay.solver.continuation.start import first_orbit

Formula = Callable[..., Sequence[float]]
"""By the state, the parameter, and a second one if that varies."""


@dataclass(frozen=True)
class KnownMap(SectionMap):
    """A section map that is a formula of state and parameter."""

    formula: Formula = lambda state, _value: state.tolist()
    impacts: Callable[..., int] = lambda _state, *_values: 0
    nearest: Callable[..., float] = lambda _state, *_values: math.nan
    speed: Callable[..., float] = lambda _state, *_values: math.nan
    phases: Callable[..., tuple[int, ...]] = lambda _state, *_values: ()

    def passages(self, sections: Sequence[Section]) -> list[Passage]:
        """Return what the formula gives, iterated for each period."""
        found = []
        for one in sections:
            end = one.state
            for _ in range(self.periods):
                end = np.array(self.formula(end, *one.values), np.float64)
            onsets = self.impacts(one.state, *one.values)
            nearest = self.nearest(one.state, *one.values)
            margins = Margins(speed=self.speed(one.state, *one.values))
            phases = self.phases(one.state, *one.values)
            told = Passage(end, onsets, 1, "", nearest, margins=margins, phases=phases)
            found.append(told)
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
    pairs: int = 0,
    **others: Callable[[Floats, float], Any],
) -> list[Row]:
    """Return the branch of fixed points from a state, from one value of the parameter to another.

    `low` : the other end of the range; else the value at which the branch begins. `pairs` : numbers
    at the end of the state that are impact rates. `others` : `nearest`, `speed` and `phases` of
    the map.
    """
    size, (begin, end) = len(start), values
    kernel: Any = SimpleNamespace(states=size - pairs, pairs=range(pairs))  # all that is asked of
    width = abs(end - begin)
    ones = np.ones(size)
    parts: Any = {"formula": formula, "impacts": impacts, "has_friction": "phases" in others}
    map_ = KnownMap(kernel, lambda _value: None, 1, 1e-13, ones, width, **parts, **others)  # type: ignore[arg-type,return-value]
    curve = Curve(map_, Scales(np.append(ones, width), np.append(ones / size, 1.0)))
    orbit = first_orbit(curve, Section(begin, np.array(start, np.float64)))
    way = np.append(np.zeros(size), np.sign(end - begin))
    ends = sorted((begin if low is None else low, end))
    return list(follow(orbit, way, Reach(ends[0], ends[1], orbits, step), sense))


def curve_of(
    label: str,
    formula: Formula,
    start: Sequence[float],
    at: tuple[float, float],
    ranges: tuple[tuple[float, float], tuple[float, float]],
    *,
    impacts: Callable[..., int] = lambda _state, *_values: 0,
    nearest: Callable[..., float] = lambda _state, *_values: math.nan,
) -> list[Row]:
    """Return special fixed points over two parameters, along the curve.

    From a state next to one, at values of both parameters, to the ends of their ranges.
    """
    size, (value, second) = len(start), at
    kernel: Any = SimpleNamespace(states=size, pairs=())
    width, height = (high - low for low, high in ranges)
    ones = np.ones(size)
    both = KnownMap(
        kernel,
        lambda *_values: None,
        1,
        1e-13,
        ones,
        width,
        formula=formula,
        impacts=impacts,
        nearest=nearest,
    )  # type: ignore[arg-type,return-value]

    def at_second(of: Callable[..., Any]) -> Callable[..., Any]:
        return lambda state, one: of(state, one, second)

    parts = {"formula": formula, "impacts": impacts, "nearest": nearest}
    alone = replace(both, **{name: at_second(of) for name, of in parts.items()})
    curve = Curve(alone, Scales(np.append(ones, width), np.append(ones / size, 1.0)))
    orbit = first_orbit(curve, Section(value, np.array(start, np.float64)))
    row = Row(replace(orbit, curve=replace(curve, map=both)), 0.0, label)
    found = special_curve(row, [row, replace(row, length=1.0)], _none, second, height)
    reach = Reach(*ranges[1], 400, 0.03, (ranges[0],))
    rows = [Row(found, 0.0, label)]
    for sense in (1.0, -1.0):
        way = np.append(np.zeros(size + 1), sense)
        rows += follow(found, way, reach, sense)
    return sorted(rows, key=lambda one: one.length)


def _none(*_values: float) -> None:
    """Return no scene: formulas need none."""
