"""Extremes that no scan of step ends finds: in which steps they are sought.

Where a run begins or ends there is no step beside that would tell that a channel turned; in long
steps of a contact, which a method of high order or of fixed steps takes, anything may happen; and
steps at the limit of stability swing inside. A free step that ends at an onset may be as long as a
flight, and the one behind the onset is a thousandth of it: a channel that turns in the first, and
once more where the contact begins, changes alike in both.
"""

import numpy as np

from jointplay.solver.kernels.emit.judging import PASSING, SWINGING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.bends import find_in_reach, look_between_bends
from jointplay.solver.kernels.loop.extremes.inner_states import look_at_inner_states
from jointplay.solver.kernels.loop.extremes.passages import look_about_fast_passages
from jointplay.solver.kernels.loop.extremes.roughness import is_due, may_set_extremes
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.kernels.loop.extremes.search.local_extremes import place_evenly, seek_between
from jointplay.solver.kernels.loop.extremes.slips_in_flight import look_at_slips_in_flight
from jointplay.solver.kernels.loop.runs import NO_PAIR
from jointplay.solver.kernels.loop.step import Step, channels_within

REACH = 3.0
"""Times that a channel may go farther beyond the ends of a step than a parabola does."""


@inner_kernel(forceinline=True)
def look_closer(s: Step) -> None:
    """Seek such extremes in a step that is taken; in steady motion hardly any step has a reason.

    To be called while ``channel`` has the values at the step's end, before the scan. Methods that
    are `watched_closely` have every step in contact looked at.
    """
    lane, at, work = s.lane, s.at, s.work
    flag = int(work[at.flag, lane])
    due = flag & SWINGING != 0 or is_due(s)
    if at.watched_closely or flag & PASSING or due:
        look_about_fast_passages(s)
    look_at_slips_in_flight(s)
    begins, ends = np.isnan(work[at.change, lane]), work[at.arrival, lane] >= work[at.end, lane]
    wanted = begins or ends or (at.watched_closely != 0 and touches(s))
    wanted |= s.run.landing != NO_PAIR and turns_before_onset(s)
    if wanted or due:
        look_inside(wanted, due, s)
    if at.inner_states > 0:
        look_at_inner_states(s)
    if work[at.may_look, lane] > 0.0 and work[at.may_pass_bend, lane] > 0.0:
        rows = np.empty(at.rows, np.int64)
        look_between_bends(rows[: find_in_reach(s, rows)], 0.0, 1.0, s)


@inner_kernel()
def look_inside(wanted: bool, due: bool, s: Step) -> None:
    """Seek extremes of all channels in a step; in one that is only due, if some may be in reach."""
    place_evenly(0.0, 1.0, s.spare[s.at.theta])
    channels_within(s)
    if due:
        wanted |= may_set_extremes(s)
    if wanted:
        seek_between(np.arange(s.at.rows), 0.0, 1.0, s)


@inner_kernel()
def touches(s: Step) -> bool:
    """Whether a pair is in contact during this step."""
    found = False
    for j in range(s.at.pairs):
        found |= s.work[s.at.mode + j, s.lane] > 0.0
    return found


@inner_kernel()
def turns_before_onset(s: Step) -> bool:
    """Whether a channel may have a new extreme inside this step, by the ends of two steps."""
    lane, at, work = s.lane, s.at, s.work
    longer = work[at.tried, lane] / work[at.before_step, lane]
    for r in range(at.rows):
        start, end = work[at.previous + r, lane], work[at.channel + r, lane]
        rose = work[at.change + r, lane]
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
