"""Whether a channel's extreme at an end of a step is one, or something next to it surpasses it.

A force begins with a contact and ends with it: so do forces of joints, and accelerations. There
these have extremes, at instants that are known, and no polynomial near them.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.brackets import (
    AT_END,
    BEST,
    BRACKETS,
    IN_THIS,
    MOST_ROUNDS,
    ROUNDS,
    ROW,
    SENSE,
    SPACING,
    START,
    STRIDE,
    VALUES,
)
from jointplay.solver.kernels.loop.extremes.extreme import LAST
from jointplay.solver.kernels.loop.extremes.extreme_so_far import count
from jointplay.solver.kernels.loop.extremes.narrowing import HALF
from jointplay.solver.kernels.loop.step import Step, channels_around

DISTANCES = (0.008, 0.04, 0.15, 0.45)
"""Instants of a look at an end, in spacings from there."""
SAME = 1e-9
"""Share of a step: instants closer than that are one."""


@inner_kernel()
def is_at_end(w: int, table: np.ndarray) -> bool:
    """Whether a bracket's best value is at an end of its step."""
    share = table[w + START] + table[w + BEST] * table[w + SPACING]
    at_begin = table[w + BEST] == 0.0 and share <= SAME
    return bool(at_begin or (table[w + BEST] == LAST and share >= 1.0 - SAME))


@inner_kernel()
def look_at_ends(waiting: int, s: Step) -> None:
    """Leave brackets whose best values are at ends of steps, where nothing next to it surpasses it.

    Those at the same end are looked at together, and one end of each of the two steps.
    """
    table, behind = s.table, BRACKETS + STRIDE * waiting
    for w in range(BRACKETS, behind, STRIDE):
        table[w + AT_END] = 1.0 if table[w + ROUNDS] < MOST_ROUNDS and is_at_end(w, table) else 0.0
    leaders = np.empty(2, np.int64)
    while find_leaders(behind, leaders, s):
        channels_around(s)
        for w in range(BRACKETS, behind, STRIDE):
            leader = leaders[int(table[w + IN_THIS])]
            if table[w + AT_END] > 0.0 and leader > 0 and same_end(w, leader, table):
                table[w + AT_END] = 0.0
                if rests(w, s):
                    table[w + ROUNDS] = MOST_ROUNDS


@inner_kernel()
def find_leaders(behind: int, leaders: np.ndarray, s: Step) -> bool:
    """Find the first bracket to be looked at in either step, and place instants at its end.

    Returns whether there is one.
    """
    table, found = s.table, False
    leaders[:] = 0
    for w in range(BRACKETS, behind, STRIDE):
        step = int(table[w + IN_THIS])
        if table[w + AT_END] > 0.0 and leaders[step] == 0:
            leaders[step], found = w, True
            for i in range(HALF):
                far = DISTANCES[i] * table[w + SPACING]
                s.spare[s.at.theta, HALF * step + i] = far if table[w + BEST] == 0.0 else 1.0 - far
    return found


@inner_kernel()
def same_end(w: int, v: int, table: np.ndarray) -> bool:
    """Whether two brackets of a step have their best values at the same end, equally spaced."""
    return bool(table[w + BEST] == table[v + BEST] and table[w + SPACING] == table[v + SPACING])


@inner_kernel()
def rests(w: int, s: Step) -> bool:
    """Whether a channel goes nowhere beyond the end of the step by the look there."""
    table, r = s.table, int(s.table[w + ROW])
    column, sense, best = HALF * int(table[w + IN_THIS]), table[w + SENSE], int(table[w + BEST])
    before = table[w + VALUES + best]
    for i in range(HALF):
        value = s.spare[s.at.channel + r, column + i]
        away = DISTANCES[i] if best == 0 else -DISTANCES[i]
        count(w, best + away, value, s)
        if sense * value > sense * before:
            return False
        before = value
    return bool(sense * table[w + VALUES + (1 if best == 0 else LAST - 1)] <= sense * before)
