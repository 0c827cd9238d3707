"""Extremes where journals pass the centres of their bearings, and the normal whips round."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.even_instants import place_evenly, seek_between
from jointplay.solver.kernels.loop.extremes.passages import (
    NARROWEST,
    closest_approach,
    distance_and_speed,
    is_through,
    orbiting_at_end,
    passes,
)
from jointplay.solver.kernels.loop.step import Step, channels_within
from jointplay.solver.kernels.trace.rows import NO_ROW

SLACK = 0.1
"""Share of a journal's speed by which the slip at a passage may exceed what is expected."""
WIDTHS = 2.0
"""Widths of a passage to either side in which extremes are sought."""


@inner_kernel()
def look_about_passages(every: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of rows about all passages between two shares of the step."""
    for j in range(s.at.pairs):
        if passes(j, s):
            share, width = closest_approach(j, s)
            if not is_through(j, share, s):
                look_about(share, width, every, low, high, s)


@inner_kernel()
def look_about_fast_passages(s: Step) -> None:
    """Seek extremes of slip and penetration where they may be beyond those so far.

    To be called while ``channel`` has the values at the step's end, before the scan.
    """
    lane, at, work = s.lane, s.at, s.work
    for j in range(at.pairs):
        if not passes(j, s):
            continue
        share, width = closest_approach(j, s)
        if NARROWEST < share < 1.0 - NARROWEST and may_be_fastest(j, share, s):
            rows, count = np.empty(2, np.int64), 0
            slip = NO_ROW if is_through(j, share, s) else work[at.slip_row + j, lane]
            for row in (slip, work[at.penetration_row + j, lane]):
                if row != NO_ROW:
                    rows[count] = int(row)
                    count += 1
            look_about(share, width, rows[:count], 0.0, 1.0, s)


@inner_kernel()
def look_about(
    share: float, width: float, rows: np.ndarray, low: float, high: float, s: Step
) -> None:
    """Seek extremes of rows about one passage of that width."""
    left, right = max(share - WIDTHS * width, low), min(share + WIDTHS * width, high)
    if left < right - NARROWEST:
        place_evenly(left, right, s)
        channels_within(s)
        seek_between(rows, left, right, s)


@inner_kernel()
def may_be_fastest(j: int, share: float, s: Step) -> bool:
    """Whether a pair's slip or penetration may have a new extreme where it passes the centre.

    There the slip is that of the spins, as at the end of the step, and all of the journal's speed.
    """
    lane, at, work = s.lane, s.at, s.work
    distance, speed = distance_and_speed(j, share, s)
    slip, depth = int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])
    found = depth != NO_ROW and distance - work[at.inner + j, lane] < work[at.lowest + depth, lane]
    if slip != NO_ROW:
        spinning = work[at.channel + slip, lane] - orbiting_at_end(j, s)
        beyond = SLACK * speed
        found |= spinning + speed + beyond > work[at.highest + slip, lane]
        found |= spinning - speed - beyond < work[at.lowest + slip, lane]
    return bool(found)
