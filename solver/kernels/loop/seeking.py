"""Seeks the extreme of one channel in a bracket of a step, more closely until it is sharp."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.brackets import (
    ABSCISSA,
    BENT,
    BEST,
    BRACKETS,
    CLOSER,
    ERROR,
    IN_THIS,
    ROUNDS,
    ROW,
    SENSE,
    SPACING,
    START,
    STRIDE,
    VALUE,
    VALUES,
)
from jointplay.solver.kernels.loop.extreme import (
    LAST,
    LEFT_OUT,
    NODES,
    extreme,
    highest,
    slope_left_out,
)
from jointplay.solver.kernels.loop.step import Step, channels_around

HALF = INSTANTS // 2
"""Instants in each of the two steps."""
SHARP = 2e-7
"""Share of a channel's range up to now to which its extremes are sought."""
FORETOLD = 2e-8
"""The same, of the bound on what a quartic foretells that is not evaluated there."""
LEAST_OFF = 0.1
"""Share of the bound that a quartic's error is taken to be where it happens to be small."""
MOST_ROUNDS = 12
"""Each narrows a bracket to a third."""
ENOUGH_AT_END = 3
"""Rounds after which a best value at the end of a step counts as it is."""
SAME = 1e-9
"""Share of a step: instants closer than that are one."""


@inner_kernel(borrows=True)
def is_done(w: int, sharp: float, s: Step) -> bool:
    """Look where a bracket's extreme is, and let it count if it is beyond that so far and sharp.

    Returns whether nothing is left to do: otherwise it may be beyond, and is not sharp. `sharp` :
    share of the channel's range up to now by which it may be off.
    """
    table = s.table
    sense = table[w + SENSE]
    r = int(table[w + ROW])
    so_far = s.work[(s.at.highest if sense > 0.0 else s.at.lowest) + r, s.lane]
    abscissa, value, error, bent = extreme(table, w + VALUES, int(table[w + BEST]), sense, so_far)
    if not sense * value + error > sense * so_far:
        return True
    table[w + ABSCISSA], table[w + VALUE], table[w + ERROR] = abscissa, value, error
    table[w + BENT] = bent
    if error > sharp * spread(r, value, s):
        return False
    count(w, abscissa, value, s)
    return True


@inner_kernel(forceinline=True, borrows=True)
def is_done_by(value: float, w: int, s: Step) -> bool:
    """Let the value at a bracket's extreme count. Returns whether it is sharp.

    What is beyond the value found is the square of the slope there by twice the second derivative.
    """
    table = s.table
    abscissa = table[w + ABSCISSA]
    count(w, abscissa, value, s)
    slope = slope_left_out(abscissa, abs(value - table[w + VALUE]))
    slope = max(slope, LEFT_OUT * LEAST_OFF * table[w + ERROR])
    sharp = SHARP * spread(int(table[w + ROW]), value, s)
    return bool(0.5 * slope * slope <= sharp * table[w + BENT])


@inner_kernel()
def seek(waiting: int, s: Step) -> None:
    """Narrow all waiting brackets until their extremes are sharp, or not beyond those so far.

    Many channels have a kink where a law has one: brackets of the same nodes are narrowed at once.
    """
    table = s.table
    behind = BRACKETS + STRIDE * waiting
    for w in range(BRACKETS, behind, STRIDE):
        while table[w + ROUNDS] < MOST_ROUNDS:
            rounds, step = table[w + ROUNDS], table[w + IN_THIS]
            start, spacing, parts = closer(w, table)
            place_closer(start, spacing, parts, HALF * int(step), s)
            channels_around(s)
            for v in range(w, behind, STRIDE):
                if table[v + ROUNDS] != rounds or table[v + IN_THIS] != step:
                    continue
                if v == w or (start, spacing, parts) == closer(v, table):
                    narrow(v, start, spacing, parts, s)
                    if is_done(v, FORETOLD, s) or rests_at_end(v, table):
                        table[v + ROUNDS] = MOST_ROUNDS
        best = table[w + BEST]
        count(w, best, table[w + VALUES + int(best)], s)


@inner_kernel()
def rests_at_end(w: int, table: np.ndarray) -> bool:
    """Whether a bracket's best value is still at an end of its step when that was looked at well.

    Beside it there may be a jump: no looking closer would tell more.
    """
    share = table[w + START] + table[w + BEST] * table[w + SPACING]
    return bool(table[w + ROUNDS] >= ENOUGH_AT_END and not SAME < share < 1.0 - SAME)


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
    work[times + r, lane] = float(s.run.periods) * s.run.period + work[at.time, lane] + time


@inner_kernel()
def closer(w: int, table: np.ndarray) -> tuple[float, float, int]:
    """Return where a closer look at a bracket begins, the distance of its nodes, how many parts.

    From the node before the best one to the one behind it, by thirds of the distance now; where
    the best is at an end of the bracket, by fifths.
    """
    best = int(table[w + BEST])
    left, right = max(best - 1, 0), min(best + 1, LAST)
    parts = 6 if right - left > 1 else HALF + 1
    spacing = table[w + SPACING] * (right - left) / parts
    return table[w + START] + left * table[w + SPACING], spacing, parts


@inner_kernel()
def place_closer(start: float, spacing: float, parts: int, first: int, s: Step) -> None:
    """Place the four instants of a closer look that are not known yet, in columns from `first`."""
    column = first
    for k in range(1, parts):
        if parts == HALF + 1 or 2 * k != parts:
            s.spare[s.at.theta, column] = min(start + k * spacing, 1.0)
            column += 1


@inner_kernel()
def narrow(w: int, start: float, spacing: float, parts: int, s: Step) -> None:
    """Narrow a bracket to five nodes about the best one of a closer look."""
    table = s.table
    r, sense = int(table[w + ROW]), table[w + SENSE]
    column = HALF * int(table[w + IN_THIS])
    best = w + VALUES + int(table[w + BEST])
    left = max(best - 1, w + VALUES)
    table[CLOSER], table[CLOSER + parts] = table[left], table[min(best + 1, w + VALUES + LAST)]
    for k in range(1, parts):
        if parts == HALF + 1 or 2 * k != parts:
            table[CLOSER + k] = s.spare[s.at.channel + r, column]
            column += 1
        else:
            table[CLOSER + k] = table[best]
    best = highest(table, CLOSER, CLOSER + parts + 1, sense) - CLOSER
    kept = min(max(best - NODES // 2, 0), parts + 1 - NODES)
    for i in range(NODES):
        table[w + VALUES + i] = table[CLOSER + kept + i]
    table[w + BEST] = best - kept
    table[w + START], table[w + SPACING] = start + kept * spacing, spacing
    table[w + ROUNDS] += 1.0
