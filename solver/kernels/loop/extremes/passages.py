"""Passages of journals by the centre of their bearing, where the normal whips round.

What follows the normal, such as the slip of a journal that touches nothing, has its extreme there,
however long the step is. The journal's position is that on the quintic which encloses it
(`solver.kernels.emit.enclosure`).
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.step import Step

MOST_ITERATIONS = 60
NARROWEST = 1e-9
"""Least width of a passage that is told apart, in steps."""
ROUNDED = 2.0**-48
"""Share of the mechanism's size by which a journal's place is rounded."""
ABOUT = (-2.0, -1.0, -0.45, -0.2, 0.0, 0.2, 0.45, 1.0)
"""Instants about the closest approach, in widths of the passage."""
AXES = 2


@inner_kernel()
def passes(j: int, s: Step) -> bool:
    """Whether pair j is open and its journal comes closest to the centre in this step."""
    lane, at, work = s.lane, s.at, s.work
    return bool(
        work[at.mode + j, lane] <= 0.0
        and work[at.gap_rate_start + j, lane] < 0.0 < work[at.gap_rate + j, lane]
    )


@inner_kernel()
def power(k: int, axis: int, j: int, s: Step) -> float:
    """Return the coefficient of share^k of one component of pair j's eccentricity, m."""
    lane, at, work = s.lane, s.at, s.work
    step = work[at.tried, lane]
    first, last = at.eccentricity_start + 6 * j + axis, at.eccentricity + 6 * j + axis
    position, rate = work[first, lane], step * work[first + AXES, lane]
    bend = 0.5 * step * step * work[first + 2 * AXES, lane]
    if k == 0:
        return float(position)
    if k == 1:
        return float(rate)
    if k == 2:
        return float(bend)
    moved = work[last, lane] - position - rate - bend
    turned = step * work[last + AXES, lane] - rate - 2.0 * bend
    bent = 0.5 * step * step * work[last + 2 * AXES, lane] - bend
    if k == 3:
        return float(10.0 * moved - 4.0 * turned + bent)
    if k == 4:
        return float(-15.0 * moved + 7.0 * turned - 2.0 * bent)
    return float(6.0 * moved - 3.0 * turned + bent)


@inner_kernel()
def closest_approach(j: int, s: Step) -> tuple[float, float]:
    """Return the share of the step at which a journal is closest to the centre, and the width.

    The width is the distance there over the way that the journal makes in a step: the share of the
    step in which the normal turns by an eighth of a turn. By Newton's rule inside a bracket.
    """
    x = np.empty((AXES, 6))
    for axis in range(AXES):
        for k in range(6):
            x[axis, k] = power(k, axis, j, s)
    low, high, share = 0.0, 1.0, 0.5
    distance = way = 0.0
    for _ in range(MOST_ITERATIONS):
        square = approach = slope = way = 0.0
        for axis in range(AXES):
            position = rate = bend = 0.0
            for k in range(5, -1, -1):
                bend = bend * share + 2.0 * rate
                rate = rate * share + position
                position = position * share + x[axis, k]
            square += position * position
            approach += position * rate
            slope += rate * rate + position * bend
            way += rate * rate
        distance, way = np.sqrt(square), np.sqrt(way)
        if approach > 0.0:
            high = share
        else:
            low = share
        better = share - approach / slope if slope > 0.0 else low
        if not low < better < high:
            better = 0.5 * (low + high)
        if abs(better - share) <= 1e-16:
            break
        share = better
    return share, max(distance / (way + 1e-300), NARROWEST)


@inner_kernel()
def distance_and_speed(j: int, share: float, s: Step) -> tuple[float, float]:
    """Return how far a journal is from the centre at a share of the step, m, and its speed, m/s."""
    square = way = 0.0
    for axis in range(AXES):
        position = rate = 0.0
        for k in range(5, -1, -1):
            rate = rate * share + position
            position = position * share + power(k, axis, j, s)
        square += position * position
        way += rate * rate
    return np.sqrt(square), np.sqrt(way) / s.work[s.at.tried, s.lane]


@inner_kernel()
def is_through(j: int, share: float, s: Step) -> bool:
    """Whether a journal passes through the centre, as far as its place tells.

    Its normal jumps there to the other side. Where it points to in between is rounding.
    """
    return bool(distance_and_speed(j, share, s)[0] <= ROUNDED * s.work[s.at.lever, s.lane])


@inner_kernel()
def orbiting_at_end(j: int, s: Step) -> float:
    """Return the velocity of a journal's centre along the tangent at the end of the step, m/s."""
    lane, at, work = s.lane, s.at, s.work
    first = at.eccentricity + 6 * j
    x, y = work[first, lane], work[first + 1, lane]
    vx, vy = work[first + AXES, lane], work[first + AXES + 1, lane]
    return float((x * vy - y * vx) / (np.sqrt(x * x + y * y) + 1e-300))


@inner_kernel()
def place_about(share: float, width: float, s: Step) -> None:
    """Place eight instants of a step about a passage, inside the step."""
    before, after = min(width, 0.5 * share), min(width, 0.5 * (1.0 - share))
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = share + ABOUT[i] * (before if ABOUT[i] < 0.0 else after)
