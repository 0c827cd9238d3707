"""Local extremes among evenly spaced values of a channel in a step: brackets about them."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.search.brackets import NODES
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import extreme_so_far
from jointplay.solver.kernels.loop.extremes.search.narrowing import FIRST
from jointplay.solver.kernels.loop.extremes.search.seeking import is_done, seek
from jointplay.solver.kernels.loop.step import Step, channels_within

CORNER = 0.5
"""Share of a second difference by which a channel may exceed its values between two of them."""
EXACT = 0.0
"""Share of its range by which what is counted may be off: a quartic through such instants may pass
where a contact ends.  Extremes are evaluated where it turns."""


@inner_kernel()
def place_evenly(low: float, high: float, theta: np.ndarray) -> None:
    """Place eight instants evenly from one share of a step to another."""
    for i in range(INSTANTS):
        theta[i] = low + (high - low) * (i / (INSTANTS - 1))


@inner_kernel()
def look_evenly(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows between two shares of a step."""
    place_evenly(low, high, s.spare[s.at.theta])
    channels_within(s)
    seek_between(chosen, low, high, s)


@inner_kernel()
def seek_between(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows that are known at even instants between two shares."""
    waiting, spacing = 0, (high - low) / (INSTANTS - 1)
    for r in chosen:
        values = s.brackets[waiting].seen
        for i in range(INSTANTS):  # a slice would take 2 s to compile, for what it raises
            values[i] = s.spare[s.at.channel + r, i]
        waiting = open_brackets(r, 1, low, spacing, INSTANTS, EXACT, waiting, s)
    seek(waiting, s)


@inner_kernel(borrows=True)
def open_brackets(
    r: int, step: int, start: float, spacing: float, count: int, sharp: float, waiting: int, s: Step
) -> int:
    """Let local extremes of a channel among `count` values of a step count, if they are sharp.

    The values are those that the next bracket has seen; `start` and `spacing` are shares of the
    step (1: this one, 0: the one before). Returns how many brackets wait to be looked at more
    closely, of all channels.
    """
    values = s.brackets[waiting].seen
    least, most, bend = spread_and_bend(values, count)
    for sense in (1.0, -1.0):
        so_far = extreme_so_far(r, sense, s)
        if not (most if sense > 0.0 else -least) + CORNER * bend > sense * so_far:
            continue
        for best in range(count):
            if not is_local_extreme(values, count, best, sense, so_far):
                continue
            bracket, kept = s.brackets[waiting], min(max(best - NODES // 2, 0), count - NODES)
            bracket.row, bracket.sense, bracket.step = r, sense, step
            bracket.start, bracket.spacing = start + kept * spacing, spacing
            bracket.best, bracket.rounds, bracket.narrowing = best - kept, 0, FIRST
            for i in range(NODES):
                bracket.values[i] = values[kept + i]
            if not is_done(bracket, sharp, s):
                waiting += 1
    return waiting


@inner_kernel()
def spread_and_bend(values: np.ndarray, count: int) -> tuple[float, float, float]:
    """Return the least and the largest of the first values, and their largest second difference."""
    least, most, bend = min(values[0], values[1]), max(values[0], values[1]), 0.0
    for i in range(2, count):
        least, most = min(least, values[i]), max(most, values[i])
        bend = max(bend, abs(values[i - 2] - 2.0 * values[i - 1] + values[i]))
    return least, most, bend


@inner_kernel()
def is_local_extreme(values: np.ndarray, count: int, i: int, sense: float, so_far: float) -> bool:
    """Whether no value beside one of so many is beyond it, and there may be a new extreme.

    A corner between two values is beyond them by half of the second difference there at most.
    """
    last = count - 1
    here, middle = sense * values[i], min(max(i, 1), last - 1)
    if (i > 0 and sense * values[i - 1] >= here) or (i < last and sense * values[i + 1] > here):
        return False
    bend = abs(values[middle - 1] - 2.0 * values[middle] + values[middle + 1])
    return bool(here + CORNER * bend > sense * so_far)
