"""The highest and lowest values of a lane's channels until now, and what is let count as one."""

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.search.brackets import Bracket
from jointplay.solver.kernels.loop.extremes.search.rounding import note_range
from jointplay.solver.kernels.loop.step import Step


@inner_kernel(borrows=True)
def extreme_so_far(r: int, sense: float, s: Step) -> float:
    """Return a channel's highest value until now (sense 1), or the lowest (sense -1)."""
    return float(s.work[(s.at.highest if sense > 0.0 else s.at.lowest) + r, s.lane])


@inner_kernel(borrows=True)
def spread(r: int, value: float, s: Step) -> float:
    """Return a channel's range up to now, with a further value, or the one known beforehand."""
    lane, at, work = s.lane, s.at, s.work
    low = min(work[at.lowest + r, lane], value)
    return max(max(work[at.highest + r, lane], value) - low, work[at.known_range + r, lane])


@inner_kernel(borrows=True)
def may_surpass(r: int, reach: float, s: Step) -> bool:
    """Whether a channel that goes beyond an end of this step by `reach` has a new extreme there."""
    lane, at, work = s.lane, s.at, s.work
    before, now = work[at.previous + r, lane], work[at.channel + r, lane]
    above = max(before, now) + reach > work[at.highest + r, lane]
    return bool(above or min(before, now) - reach < work[at.lowest + r, lane])


@inner_kernel(borrows=True)
def count(bracket: Bracket, abscissa: float, value: float, s: Step) -> None:
    """Note a value at an abscissa of a bracket, if it is beyond its channel's extreme so far."""
    lane, at, work, r = s.lane, s.at, s.work, bracket.row
    block, times = at.lowest, at.lowest_time
    if bracket.sense > 0.0:
        block, times = at.highest, at.highest_time
    if not bracket.sense * value > bracket.sense * work[block + r, lane]:
        return
    share = bracket.start + abscissa * bracket.spacing
    time = share * work[at.tried, lane]
    if bracket.step == 0:
        time = (share - 1.0) * work[at.before_step, lane]
    work[block + r, lane] = value
    if r < at.contact_row:
        note_range(r, s)
    work[times + r, lane] = float(s.run.periods) * s.run.period + work[at.time, lane] + time


@inner_kernel()
def count_best(bracket: Bracket, s: Step) -> None:
    """Let the best value of a bracket count as it is."""
    count(bracket, float(bracket.best), bracket.values[bracket.best], s)


@inner_kernel()
def count_end(now: float, s: Step) -> None:
    """Let the values at the run's last instant count, s since the start."""
    lane, at, work = s.lane, s.at, s.work
    for r in range(at.rows):
        value = work[at.previous + r, lane]
        if value > work[at.highest + r, lane]:
            work[at.highest + r, lane], work[at.highest_time + r, lane] = value, now
        if value < work[at.lowest + r, lane]:
            work[at.lowest + r, lane], work[at.lowest_time + r, lane] = value, now
