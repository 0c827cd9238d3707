"""Starts of branches: a section that the motion has come to, and the orbit next to it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit, Scales
from jointplay.solver.continuation.section_map import ATTEMPTS, Answers, Section, SectionMap
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import LaneProblem, LaneStart
from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.runs.lane_results import failure_of
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.periods import common_period

SAMPLES_PER_PERIOD = 64
LEAST_EXTENT = 1e-3
"""Least extent of a state that hardly moves, in what counts as one in it."""
SAME = 1e-6
"""Distance, in the scales of the states, within which an orbit has come back."""


class NoStart(Exception):
    """There is no orbit to start from; the sentence says what was tried."""


@dataclass(frozen=True)
class Settled:
    """A motion after some periods."""

    state: Floats
    """(states + pairs,) at the section there; see `Section`."""
    extents: Floats
    """(states,) how far each state moved in the last periods."""
    steps: float
    """Accepted steps a period."""


def settle(map_: SectionMap, value: float, state: Floats | None, periods: int) -> Settled:
    """Return where a motion is after some periods, from the scene's start or a given state.

    The last periods, as many as the map's, are looked at.

    Raises
    ------
    NoStart
        The motion could not be followed that far.
    """
    (numbers,), (failure,) = map_.recall(lambda: _settled(map_, value, state, periods))
    if failure:
        raise NoStart(failure)
    total = periods + map_.periods
    return Settled(numbers[: map_.size], numbers[map_.size : -1], float(numbers[-1]) / total)


def _settled(map_: SectionMap, value: float, state: Floats | None, periods: int) -> Answers:
    scene, kernel = map_.scene_at(value), map_.kernel
    total = periods + map_.periods
    period = common_period(scene).seconds or math.nan
    problem = LaneProblem(
        scene,
        total * period,
        map_.tolerance,
        period / SAMPLES_PER_PERIOD,
        SAMPLES_PER_PERIOD * total + 1,
        0,
        0.0,
        start=None if state is None else LaneStart.at_section(state, kernel.states),
        first_sample=SAMPLES_PER_PERIOD * periods,
    )
    bundle = Bundle(kernel, [problem], watch=False)
    low, high = np.full(kernel.states, math.inf), np.full(kernel.states, -math.inf)
    running = 1
    while running:
        running = bundle.advance(ATTEMPTS)
        states = kernel.row.states(bundle.rows(SAMPLES, 0))
        low = np.minimum(low, states.min(axis=0, initial=math.inf))
        high = np.maximum(high, states.max(axis=0, initial=-math.inf))
        map_.looked()
    at = bundle.lane(0)
    failed = at.status != Status.DONE
    failure = failure_of(bundle, 0, map_.tolerance, scene).detail if failed else ""
    numbers = np.concatenate([at["y"], at["impact_rate"] * at["mode"], high - low, [at.steps]])
    return numbers[None], [failure]


def scaled(map_: SectionMap, value: float, settled: Settled) -> Curve:
    """Return the curve of orbits in the scales of a motion.

    Differences are shares of what counts as one in each state, or of its extent if that is less;
    lengths along the branch are in extents, so that a state that moves far does not rule them.
    """
    scene, kernel = map_.scene_at(value), map_.kernel
    period = common_period(scene).seconds or math.nan
    one = start_scales(scene, kernel.coordinates, period)
    pairs = len(kernel.pairs)
    extents = np.maximum(settled.extents, LEAST_EXTENT * one)
    count = len(kernel.coordinates)
    rates = np.full(pairs, extents[count : 2 * count].max(initial=0.0) or 1.0)
    scales = np.concatenate([np.minimum(one, extents), rates])
    weight = np.concatenate([np.full(kernel.states, 1.0 / kernel.states), np.zeros(pairs), [1.0]])
    whole = np.concatenate([extents, rates, [map_.width]])
    map_ = replace(map_, scales=scales, steps=settled.steps)
    return Curve(map_, Scales(whole, weight))


def first_orbit(curve: Curve, section: Section) -> Orbit:
    """Return the periodic orbit next to a section, at its value of the parameter.

    Raises
    ------
    NoStart
        There is none near, or it repeats after fewer periods.
    """
    axis = np.zeros(curve.map.size + 1)
    axis[-1] = 1.0
    found = curve.orbit(curve.vector(section), axis)
    if isinstance(found, NoOrbit):
        raise NoStart(
            f"There is no orbit of period {curve.map.periods} near the section that was reached:"
            f" {found.reason}. Try another 'period', more periods to 'settle', a value of the"
            " parameter at which the motion is not chaotic, or a 'state' next to the orbit."
        )
    shorter = shorter_period(found)
    if shorter:
        raise NoStart(
            f"The orbit that was found repeats after {shorter} of the {curve.map.periods} periods;"
            f" ask for 'period' {shorter}."
        )
    return found


def shorter_period(orbit: Orbit) -> int:
    """Return after how many periods an orbit is back already, fewer than its own; 0: it is not."""
    map_, section = orbit.curve.sections, orbit.section
    states = map_.kernel.states
    for periods in range(1, map_.periods):
        if map_.periods % periods:
            continue
        (passage,) = replace(map_, periods=periods).passages([section])
        away = np.abs((passage.end - section.state) / map_.scales)[:states]
        if float(away.max()) < SAME:
            return periods
    return 0
