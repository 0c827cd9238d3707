"""Extremes of friction's own states, such as bristles, inside steps.

Bristles that slide are stiff: an explicit method's steps are as long as is stable, and their
deflection swings inside by the error that a step may make, whatever the motion does, and while
apart, too. The slopes at both ends of a step tell how far.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import may_surpass
from jointplay.solver.kernels.loop.extremes.search.local_extremes import (
    CORNER,
    look_evenly,
    place_evenly,
    spread_and_bend,
)
from jointplay.solver.kernels.loop.step import Step, states_within
from jointplay.solver.kernels.trace.rows import NO_ROW


@inner_kernel()
def is_in_reach(k: int, s: Step) -> bool:
    """Whether inner state `k` may have an extreme inside the step that is worth a look."""
    lane, at, work = s.lane, s.at, s.work
    row = int(work[at.inner_row + k, lane])
    if row == NO_ROW:
        return False
    i = 2 * at.step_row.coordinates + k
    slopes = abs(work[at.k1_ + i, lane]) + abs(work[at.slope + i, lane])
    least = SHARP * (work[at.highest + row, lane] - work[at.lowest + row, lane])
    return may_surpass(row, work[at.tried, lane] * slopes - least, s)


@inner_kernel()
def surpasses(k: int, s: Step) -> bool:
    """Whether inner state `k`, known at even instants, may have a new extreme worth a look."""
    lane, at, work = s.lane, s.at, s.work
    row = int(work[at.inner_row + k, lane])
    values = s.spare[at.stage + 2 * at.step_row.coordinates + k]
    least, most, bend = spread_and_bend(values, INSTANTS)
    lowest, highest = work[at.lowest + row, lane], work[at.highest + row, lane]
    beyond = CORNER * bend - SHARP * (highest - lowest)
    return bool(most + beyond > highest or least - beyond < lowest)


@inner_kernel()
def look_at_inner_states(s: Step) -> None:
    """Seek extremes of inner states inside the step."""
    any_may = False
    for k in range(s.at.inner_states):
        any_may |= is_in_reach(k, s)
    if not any_may:
        return
    place_evenly(0.0, 1.0, s.spare[s.at.theta])
    states_within(s)
    rows, count = np.empty(s.at.inner_states, np.int64), 0
    for k in range(s.at.inner_states):
        if is_in_reach(k, s) and surpasses(k, s):
            rows[count] = int(s.work[s.at.inner_row + k, s.lane])
            count += 1
    if count > 0:
        look_evenly(rows[:count], 0.0, 1.0, s)
