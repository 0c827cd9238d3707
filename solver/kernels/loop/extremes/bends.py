"""Extremes inside steps whose slip comes to where friction bends: each piece between is looked at.

A step may enter a steep ramp of friction and leave it again, as if nothing had happened between its
ends; `solver.kernels.emit.bends` says which may. From one passage of a bend to the next everything
is smooth.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.cuts_at_bends import MOST_INSTANTS, find_cuts, has_bend
from jointplay.solver.kernels.loop.extremes.even_instants import look_evenly
from jointplay.solver.kernels.loop.step import Step

SWAY = 2.0
"""Part of its range that friction may make of a channel in a step with the largest normal force."""


@inner_kernel()
def find_in_reach(s: Step, found: np.ndarray) -> int:
    """Write the rows that friction may bring to a new extreme in this step. Returns how many.

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
    cuts, begin = np.empty((MOST_INSTANTS + 1, 2)), low
    count = find_cuts(low, high, s, cuts)
    cuts[count] = high
    for end, behind in cuts[: count + 1]:
        if begin < end:
            look_evenly(chosen, begin, end, s)
        begin = max(begin, behind)
