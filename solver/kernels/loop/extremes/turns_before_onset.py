"""Extremes in the step before an onset that step ends do not show.

A free step may be as long as a flight, and the one behind the onset is a thousandth of it. A
channel that turns in the first, and once more where the contact begins, changes alike in both.
"""

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.seeking import SHARP
from jointplay.solver.kernels.loop.step import Step

REACH = 3.0
"""Times that a channel may go farther beyond the ends of a step than a parabola does."""


@inner_kernel()
def turns_before_onset(s: Step) -> bool:
    """Whether a channel may have a new extreme inside this step, by the ends of two steps.

    To be called while ``channel`` has the values at the step's end, before the scan.
    """
    lane, at, work = s.lane, s.at, s.work
    longer = work[at.tried, lane] / work[at.before_step, lane]
    for r in range(at.rows):
        start, end, rose = (
            work[at.previous + r, lane],
            work[at.channel + r, lane],
            work[at.change + r, lane],
        )
        # start + slope t + bend t², t in steps of the length before
        bend = ((end - start) / longer - rose) / (1.0 + longer)
        slope = rose + bend
        if not slope * (slope + 2.0 * bend * longer) < 0.0:
            continue
        turn = start - 0.25 * slope * slope / bend
        lowest, highest = work[at.lowest + r, lane], work[at.highest + r, lane]
        if bend > 0.0:
            beyond, rest = min(start, end) - turn, min(start, end) - lowest
        else:
            beyond, rest = turn - max(start, end), highest - max(start, end)
        reach = (1.0 + REACH) * beyond
        if reach > rest and reach > SHARP * (highest - lowest):
            return True
    return False
