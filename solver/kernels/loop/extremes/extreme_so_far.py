"""The highest and lowest values of a lane's channels until now, and what is let count as one."""

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.brackets import (
    BEST,
    IN_THIS,
    ROW,
    SENSE,
    SPACING,
    START,
    VALUES,
)
from jointplay.solver.kernels.loop.extremes.rounding import note_range
from jointplay.solver.kernels.loop.step import Step


@inner_kernel(borrows=True)
def spread(r: int, value: float, s: Step) -> float:
    """Return a channel's range up to now, with a further value, or the one known beforehand."""
    lane, at, work = s.lane, s.at, s.work
    low = min(work[at.lowest + r, lane], value)
    return max(max(work[at.highest + r, lane], value) - low, work[at.known_range + r, lane])


@inner_kernel(borrows=True)
def count(w: int, abscissa: float, value: float, s: Step) -> None:
    """Note a value at an abscissa of a bracket, if it is beyond its channel's extreme so far."""
    lane, at, work, table = s.lane, s.at, s.work, s.table
    r, sense = int(table[w + ROW]), table[w + SENSE]
    block, times = at.lowest, at.lowest_time
    if sense > 0.0:
        block, times = at.highest, at.highest_time
    if not sense * value > sense * work[block + r, lane]:
        return
    share = table[w + START] + abscissa * table[w + SPACING]
    time = share * work[at.tried, lane]
    if table[w + IN_THIS] == 0.0:
        time = (share - 1.0) * work[at.before_step, lane]
    work[block + r, lane] = value
    if r < at.contact_row:
        note_range(r, s)
    work[times + r, lane] = float(s.run.periods) * s.run.period + work[at.time, lane] + time


@inner_kernel()
def count_best(w: int, s: Step) -> None:
    """Let the best value of a bracket count as it is."""
    best = s.table[w + BEST]
    count(w, best, s.table[w + VALUES + int(best)], s)
