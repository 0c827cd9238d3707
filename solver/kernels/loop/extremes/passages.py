"""Passages of journals by the centre of their bearing, where the normal whips round.

What follows the normal, such as the slip of a journal that touches nothing, has its extreme there,
however long the step is. Where the normal jumps, at a passage through the centre itself, slip has
no direction and is not looked at. The journal's position is that on the quintic which encloses it
(`solver.kernels.emit.enclosure`).
"""

from typing import NamedTuple

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import MOTION
from jointplay.solver.kernels.loop.extremes.search.brackets import TINY
from jointplay.solver.kernels.loop.extremes.search.local_extremes import look_evenly
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.trace.rows import NO_ROW

MOST_ITERATIONS = 60
NARROWEST = 1e-9
"""Least width of a passage that is told apart, in steps."""
ROUNDED = 2.0**-48
"""Share of the mechanism's size by which a journal's place is rounded."""
ABOUT = (-2.0, -1.0, -0.45, -0.2, 0.0, 0.2, 0.45, 1.0)
"""Instants about the closest approach, in widths of the passage."""
SLACK = 0.1
"""Share of a journal's speed by which the slip at a passage may exceed what is expected."""
WIDTHS = 2.0
"""Widths of a passage to either side in which extremes are sought."""
AXES = 2
PARTS = 8
"""Parts of a step, in each of which a journal comes closest to the centre once at most."""


class Passage(NamedTuple):
    """A journal where it is closest to the centre of its bearing."""

    share: float
    """Share of the step at which that is."""
    width: float
    """Share of the step in which the normal turns by an eighth of a turn: the distance over the way
    that the journal makes in a step."""
    distance: float
    """Distance from the centre, m."""
    speed: float
    """Its speed, m/s."""


@inner_kernel()
def path_of(j: int, s: Step) -> np.ndarray:
    """Return the coefficients (AXES, 6) of pair j's eccentricity, m, by powers of the share."""
    lane, at, work = s.lane, s.at, s.work
    step, path = work[at.tried, lane], np.empty((AXES, 6))
    for axis in range(AXES):
        first, last = at.eccentricity_start + MOTION * j + axis, at.eccentricity + MOTION * j + axis
        position, rate = work[first, lane], step * work[first + AXES, lane]
        bend = 0.5 * step * step * work[first + 2 * AXES, lane]
        moved = work[last, lane] - position - rate - bend
        turned = step * work[last + AXES, lane] - rate - 2.0 * bend
        bent = 0.5 * step * step * work[last + 2 * AXES, lane] - bend
        path[axis, 0], path[axis, 1], path[axis, 2] = position, rate, bend
        path[axis, 3] = 10.0 * moved - 4.0 * turned + bent
        path[axis, 4] = -15.0 * moved + 7.0 * turned - 2.0 * bent
        path[axis, 5] = 6.0 * moved - 3.0 * turned + bent
    return path


@inner_kernel()
def motion_at(path: np.ndarray, share: float) -> tuple[float, float, float, float]:
    """Return how a journal moves at a share of the step; rates are in a whole step.

    The square of its distance from the centre, m²; half the rate of that, and the rate of this
    half, m²; the square of its way in a step, m².
    """
    square = half = slope = way = 0.0
    for axis in range(AXES):
        position = rate = bend = 0.0
        for k in range(5, -1, -1):
            bend = bend * share + 2.0 * rate
            rate = rate * share + position
            position = position * share + path[axis, k]
        square += position * position
        half += position * rate
        slope += rate * rate + position * bend
        way += rate * rate
    return square, half, slope, way


@inner_kernel()
def next_passage(j: int, part: int, path: np.ndarray, s: Step) -> int:
    """Return the next of `PARTS` of the step, from one on, in which a journal comes closest.

    `PARTS` : none; so for a pair that touches. A journal that turns outside may come back in a
    step, and one that is thrown up fall back.
    """
    if s.work[s.at.mode + j, s.lane] > 0.0:
        return PARTS
    _, begins, _, _ = motion_at(path, part / PARTS)
    for k in range(part, PARTS):
        _, ends, _, _ = motion_at(path, (k + 1) / PARTS)
        if begins < 0.0 <= ends:
            return k
        begins = ends
    return PARTS


@inner_kernel()
def passes(j: int, s: Step) -> bool:
    """Whether pair j is open and its journal comes closest to the centre in this step."""
    return bool(next_passage(j, 0, path_of(j, s), s) < PARTS)


@inner_kernel()
def closest_approach(path: np.ndarray, part: int, s: Step) -> Passage:
    """Return where a journal is closest to the centre in a part: by Newton's rule in a bracket."""
    low, high = part / PARTS, (part + 1) / PARTS
    share, square, way = 0.5 * (low + high), 0.0, 0.0
    for _ in range(MOST_ITERATIONS):
        square, half, slope, way = motion_at(path, share)
        if half > 0.0:
            high = share
        else:
            low = share
        better = share - half / slope if slope > 0.0 else low
        if not low < better < high:
            better = 0.5 * (low + high)
        if abs(better - share) <= 1e-16:
            break
        share = better
    distance, way = np.sqrt(square), np.sqrt(way)
    width = max(distance / (way + TINY), NARROWEST)
    return Passage(share, width, distance, way / s.work[s.at.tried, s.lane])


@inner_kernel()
def is_through(passage: Passage, s: Step) -> bool:
    """Whether a journal passes through the centre, as far as its place tells.

    Its normal jumps there to the other side. Where it points to in between is rounding.
    """
    return bool(passage.distance <= ROUNDED * s.work[s.at.lever, s.lane])


@inner_kernel()
def orbiting_at_end(j: int, s: Step) -> float:
    """Return the velocity of a journal's centre along the tangent at the end of the step, m/s."""
    lane, at, work = s.lane, s.at, s.work
    first = at.eccentricity + MOTION * j
    x, y = work[first, lane], work[first + 1, lane]
    vx, vy = work[first + AXES, lane], work[first + AXES + 1, lane]
    return float((x * vy - y * vx) / (np.sqrt(x * x + y * y) + TINY))


@inner_kernel()
def beside(i: int, passage: Passage) -> float:
    """Return the share of a step at which the instant `i` of eight about a passage is."""
    share, width = passage.share, passage.width
    before, after = min(width, 0.5 * share), min(width, 0.5 * (1.0 - share))
    return float(share + ABOUT[i] * (before if ABOUT[i] < 0.0 else after))


@inner_kernel()
def look_about_passages(every: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of rows about all passages between two shares of the step."""
    for j in range(s.at.pairs):
        path = path_of(j, s)
        part = next_passage(j, 0, path, s)
        while part < PARTS:
            passage = closest_approach(path, part, s)
            if not is_through(passage, s):
                look_about(passage, every, low, high, s)
            part = next_passage(j, part + 1, path, s)


@inner_kernel()
def look_about_fast_passages(s: Step) -> None:
    """Seek extremes of slip and penetration where they may be beyond those so far."""
    for j in range(s.at.pairs):
        path = path_of(j, s)
        part = next_passage(j, 0, path, s)
        while part < PARTS:
            look_about_fast(j, closest_approach(path, part, s), s)
            part = next_passage(j, part + 1, path, s)


@inner_kernel()
def look_about_fast(j: int, passage: Passage, s: Step) -> None:
    """Seek extremes of pair j's slip and penetration about a passage, if they may be beyond."""
    inside = NARROWEST < passage.share < 1.0 - NARROWEST
    if inside and may_be_fastest(j, passage, s):
        lane, at, work = s.lane, s.at, s.work
        rows, count = np.empty(2, np.int64), 0
        slip = NO_ROW if is_through(passage, s) else work[at.slip_row + j, lane]
        for row in (slip, work[at.penetration_row + j, lane]):
            if row != NO_ROW:
                rows[count] = int(row)
                count += 1
        look_about(passage, rows[:count], 0.0, 1.0, s)


@inner_kernel()
def look_about(passage: Passage, rows: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of rows about one passage."""
    reach = WIDTHS * passage.width
    left, right = max(passage.share - reach, low), min(passage.share + reach, high)
    if left < right - NARROWEST:
        look_evenly(rows, left, right, s)


@inner_kernel()
def may_be_fastest(j: int, passage: Passage, s: Step) -> bool:
    """Whether a pair's slip or penetration may have a new extreme where it passes the centre.

    There the slip is that of the spins, as at the end of the step, and all of the journal's speed.
    """
    lane, at, work = s.lane, s.at, s.work
    slip, depth = int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])
    found = False
    if depth != NO_ROW:
        found |= passage.distance - work[at.inner + j, lane] < work[at.lowest + depth, lane]
    if slip != NO_ROW:
        spinning = work[at.channel + slip, lane] - orbiting_at_end(j, s)
        beyond = SLACK * passage.speed
        found |= spinning + passage.speed + beyond > work[at.highest + slip, lane]
        found |= spinning - passage.speed - beyond < work[at.lowest + slip, lane]
    return bool(found)
