"""Extremes inside steps whose slip comes to where friction bends: each piece between is looked at.

A step may enter a steep ramp of friction and leave it again, as if nothing had happened between its
ends. From one passage of a bend to the next everything is smooth.
"""

import math

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.cuts_at_bends import (
    MOST_PLACES,
    bends_below,
    find_cuts,
    has_bend,
)
from jointplay.solver.kernels.loop.inner_peaks import place_evenly
from jointplay.solver.kernels.loop.looks_into_steps import look_at_suspects
from jointplay.solver.kernels.loop.step import Step, channels_within

BEYOND = 0.5
"""Part of what a cubic goes beyond its ends by which slip may go further than the cubic."""
RATES = 0.02
"""Part of the way at the rates of both ends by which slip may go further, too."""
SWAY = 2.0
"""Part of its range that friction may make of a channel in a step with the largest normal force."""


@inner_kernel()
def beyond_ends(change: float, begin: float, end: float) -> tuple[float, float]:
    """Return how far a cubic goes below and above both of its ends, from 0 to `change`.

    begin, end
        Its slopes there, as changes over the whole step.
    """
    curving, bending = 6.0 * change - 4.0 * begin - 2.0 * end, 3.0 * (begin + end) - 6.0 * change
    below, above = min(0.0, change), max(0.0, change)
    least, most = below, above
    root = curving * curving - 4.0 * bending * begin  # of the cubic's slope, a parabola
    if root >= 0.0:
        q = -0.5 * (curving + math.copysign(math.sqrt(root), curving))
        for above_line, below_line in ((q, bending), (begin, q)):
            if 0.0 < above_line * below_line < below_line * below_line:
                share = above_line / below_line
                value = share * (begin + share * (0.5 * curving + share * bending / 3.0))
                least, most = min(least, value), max(most, value)
    return below - least, most - above


@inner_kernel(forceinline=True, borrows=True)
def may_pass_bend(s: Step) -> bool:
    """Whether a slip may pass a bend and come back in this step, or pass more than one.

    Both is told by its values and rates at both ends: one bend that is passed once shows there.
    """
    lane, at, work = s.lane, s.at, s.work
    step = work[at.tried, lane]
    for j in range(at.pairs):
        if has_bend(j, s):
            before, now = work[at.slip_start + j, lane], work[at.slip + j, lane]
            begin = step * work[at.slip_rate_start + j, lane]
            end = step * work[at.slip_rate + j, lane]
            below, above = beyond_ends(now - before, begin, end)
            margin = RATES * (abs(begin) + abs(end))
            low, high = min(before, now), max(before, now)
            least = low - (1.0 + BEYOND) * below - margin
            most = high + (1.0 + BEYOND) * above + margin
            first, last = bends_below(low, j, s), bends_below(high, j, s)
            if (
                last - first > 1
                or bends_below(least, j, s) < first
                or bends_below(most, j, s) > last
            ):
                return True
    return False


@inner_kernel()
def find_in_reach(s: Step, found: np.ndarray) -> int:
    """Write the rows that friction may bring to a record in this step. Returns how many.

    It is as large as the normal force allows, and so it was where that was largest.
    """
    lane, at, work = s.lane, s.at, s.work
    share, count = 0.0, 0
    for j in range(at.pairs):
        if has_bend(j, s):
            row = int(work[at.normal_row + j, lane])
            normal = max(work[at.previous + row, lane], work[at.channel + row, lane])
            share = max(share, normal / work[at.highest + row, lane])
    for r in range(at.rows):
        before, now = work[at.previous + r, lane], work[at.channel + r, lane]
        lowest, highest = work[at.lowest + r, lane], work[at.highest + r, lane]
        reach = SWAY * share * (highest - lowest)
        if not (max(before, now) + reach < highest and min(before, now) - reach > lowest):
            found[count] = r
            count += 1
    return count


@inner_kernel()
def look_between_bends(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows between two shares, from one passage of a bend to the next."""
    if len(chosen) == 0:
        return
    cuts, begin = np.empty((MOST_PLACES + 1, 2)), low
    count = find_cuts(low, high, s, cuts)
    cuts[count] = high
    for end, behind in cuts[: count + 1]:
        if begin < end:
            place_evenly(begin, end, s)
            channels_within(s)
            look_at_suspects(chosen, begin, end, s)
        begin = max(begin, behind)
