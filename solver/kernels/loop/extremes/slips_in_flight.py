"""Slips of journals that touch nothing: they turn inside steps that no error keeps short.

The slip of a free journal follows its normal, which turns the faster the nearer the journal is to
the centre of its bearing. The ends of a few steps need not show that it turned in one and turned
again in the next: its rates at both ends of a step do.
"""

import numpy as np

from jointplay.solver.kernels.emit.judging import PASSING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import may_surpass
from jointplay.solver.kernels.loop.extremes.search.local_extremes import look_evenly
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.trace.rows import NO_ROW

FARTHER = 2.0
"""Times that a slip may go farther beyond the ends of a step than a parabola of their rates."""
FARTHEST = 0.5
"""The most where rates do not tell that it turns, but its normal whips round: in changes over the
step at the rates of both ends. A cubic goes 4/27."""


@inner_kernel()
def look_at_slips_in_flight(s: Step) -> None:
    """Seek extremes of free journals' slips that turn in a step, if they may be new."""
    rows, count = np.empty(s.at.pairs, np.int64), 0
    for j in range(s.at.pairs):
        if turns_in_flight(j, s):
            rows[count] = int(s.work[s.at.slip_row + j, s.lane])
            count += 1
    if count > 0:
        look_evenly(rows[:count], 0.0, 1.0, s)


@inner_kernel()
def turns_in_flight(j: int, s: Step) -> bool:
    """Whether pair j is open and its slip may have a new extreme inside this step."""
    lane, at, work = s.lane, s.at, s.work
    row = int(work[at.slip_row + j, lane])
    if work[at.mode + j, lane] > 0.0 or row == NO_ROW:
        return False
    first, last = work[at.slip_rate_start + j, lane], work[at.slip_rate + j, lane]
    tried = work[at.tried, lane]
    if first * last < 0.0:
        before = work[at.previous + row, lane]
        away = 0.5 * FARTHER * tried * first * first / (abs(first) + abs(last))
        if first > 0.0:
            return bool(before + away > work[at.highest + row, lane])
        return bool(before - away < work[at.lowest + row, lane])
    if not int(work[at.flag, lane]) & PASSING:
        return False
    return may_surpass(row, FARTHEST * tried * (abs(first) + abs(last)), s)
