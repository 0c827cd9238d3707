"""The motion from which an orbit is sought: where it comes to, and how far it moves."""

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.crossing import PATIENCE, Crossings
from jointplay.solver.continuation.section_map import TURN, SectionMap
from jointplay.solver.continuation.section_runs import ATTEMPTS, Answers
from jointplay.solver.kernels.loop.runs import SAMPLES, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.runs.geared_wheels import geared_angles, periods_until_back
from jointplay.solver.runs.lane_results import failure_of
from jointplay.solver.scene.document import Scene

SAMPLES_PER_PERIOD = 64


class NoStart(Exception):
    """There is no orbit to start from; the sentence says what was tried."""


@dataclass(frozen=True)
class Settled:
    """A motion after some periods."""

    state: Floats
    """(states + pairs,) at the section there; see `Section`."""
    extents: Floats
    """(states,) how far each state moved in the last periods."""
    interval: float
    """Time of a period, s; where nothing drives the mechanism, from crossing to crossing."""
    steps: float
    """Accepted steps a period."""
    back_after: int = 1
    """Periods after which wheels behind gears are back; see `geared_wheels`."""


def settle(map_: SectionMap, value: float, state: Floats | None, periods: int) -> Settled:
    """Return where a motion is after some periods, from the scene's start or a given state.

    The last periods, as many as the map's, are looked at. Where nothing drives the mechanism, the
    first are scales of time, and crossings behind them count.

    Raises
    ------
    NoStart
        The motion could not be followed that far.
    """
    (numbers,), (failure,) = map_.recall(lambda: _settled(map_, value, state, periods))
    if failure:
        raise NoStart(failure)
    extents, gone = numbers[map_.size : -2].reshape(2, map_.kernel.states)
    geared = geared_angles(map_.scene_at(value), map_.kernel.coordinates)
    back_after = periods_until_back(gone[geared] / (TURN * map_.periods))
    interval, steps = numbers[-2:].tolist()
    return Settled(numbers[: map_.size], extents, interval, steps, back_after)


def _settled(map_: SectionMap, value: float, state: Floats | None, periods: int) -> Answers:
    scene, kernel = map_.scene_at(value), map_.kernel
    start = None if state is None else LaneStart.at_section(state, kernel.states)
    problem = _problem(map_, scene, start, periods)
    bundle = Bundle(kernel, [problem], watch=False)
    crossings = Crossings(bundle, 1)
    low, high = np.full(kernel.states, math.inf), np.full(kernel.states, -math.inf)
    begun, running = list[Floats](), 1
    while running:
        running = bundle.advance(ATTEMPTS)
        states = kernel.row.states(bundle.rows(SAMPLES, 0))
        begun += [one.copy() for one in states[: 1 - len(begun)]]
        low = np.minimum(low, states.min(axis=0, initial=math.inf))
        high = np.maximum(high, states.max(axis=0, initial=-math.inf))
        crossings.collect()
        map_.looked()
    at, total, failure = bundle.lane(0), periods + map_.periods, ""
    end, interval, steps = at.row()[0], map_.interval(scene), at.steps / total
    rows = crossings.rows[0]
    if at.status != Status.DONE:
        failure = failure_of(bundle, 0, map_.tolerance, scene).detail
    elif map_.crossing is not None and len(rows) <= map_.periods:
        failure = _too_few_crossings(len(rows), problem)
    elif map_.crossing is not None:
        first, last = (float(bundle.times(0, row)) for row in (rows[0], rows[-1]))
        begun, interval = [kernel.row.states(rows[0])], (last - first) / map_.periods
        end = rows[-1]
        steps = at.steps * interval / last
    gone = kernel.row.states(end) - begun[0] if begun else low
    numbers = [map_.numbers_at(end), high - low, gone, [interval, steps]]
    return np.concatenate(numbers)[None], [failure]


def _problem(map_: SectionMap, scene: Scene, start: LaneStart | None, periods: int) -> LaneProblem:
    period, crossing = map_.interval(scene), map_.crossing
    first, total = periods, periods + map_.periods
    if crossing is not None:  # its first crossing may come at once
        first, total = max(periods - 1, 0), periods + PATIENCE * (map_.periods + 1)
    return LaneProblem(
        scene,
        total * period,
        map_.tolerance,
        period / SAMPLES_PER_PERIOD,
        SAMPLES_PER_PERIOD * total + 1,
        0 if crossing is None else map_.periods + 1,
        0.0,
        event=None if crossing is None else crossing.behind(periods * period),
        start=start,
        first_sample=SAMPLES_PER_PERIOD * first,
        ledger=False,
    )


def _too_few_crossings(crossings: int, problem: LaneProblem) -> str:
    wanted, until = problem.sections, problem.duration
    return (
        f"The motion is at the section {crossings} instead of {wanted} times until {until:.3g} s."
        " Try another value of the channel, a 'state' on the orbit, a value of the parameter at"
        " which the mechanism does not come to rest, or a longer 'period' of the scene, which is"
        " its scale of time."
    )
