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

DISTANCES = (1e-4, 0.008, 0.06, 0.45)
"""Instants of a look at an end, in spacings from there. What begins at the end and turns a channel
that rises by a tenth of its range in a step hides at most 1e-6 of that before the nearest."""
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
    while place_at_ends(behind, s):
        channels_around(s)
        for w in range(BRACKETS, behind, STRIDE):
            first = s.spare[s.at.theta, HALF * int(table[w + IN_THIS])]
            if table[w + AT_END] > 0.0 and first == beside_end(0, w, table):
                table[w + AT_END] = 0.0
                look_at_end(w, s)


@inner_kernel()
def beside_end(i: int, w: int, table: np.ndarray) -> float:
    """Return where in its step the instant `i` of a look at a bracket's end is."""
    far = DISTANCES[i] * table[w + SPACING]
    return float(far if table[w + BEST] == 0.0 else 1.0 - far)


@inner_kernel()
def place_at_ends(behind: int, s: Step) -> bool:
    """Place instants at the end of the first bracket that is to be looked at in either step.

    Returns whether there is one.
    """
    table, placed = s.table, np.zeros(2, np.bool_)
    for w in range(BRACKETS, behind, STRIDE):
        step = int(table[w + IN_THIS])
        if table[w + AT_END] > 0.0 and not placed[step]:
            placed[step] = True
            for i in range(HALF):
                s.spare[s.at.theta, HALF * step + i] = beside_end(i, w, table)
    return bool(placed[0] or placed[1])


@inner_kernel()
def look_at_end(w: int, s: Step) -> None:
    """Leave a bracket if its channel only falls behind the end of the step, by the look there.

    If it rises and then falls, the bracket is narrowed to the end and the instant behind the best.
    """
    table, column = s.table, HALF * int(s.table[w + IN_THIS])
    sense, best, spacing = table[w + SENSE], int(table[w + BEST]), table[w + SPACING]
    away = 1 if best == 0 else -1
    look = s.spare[s.at.channel + int(table[w + ROW]), column : column + HALF]
    rises, before = 0, table[w + VALUES + best]
    for i in range(HALF + 1):
        value = look[i] if i < HALF else table[w + VALUES + best + away]
        if i < HALF:
            count(w, best + away * DISTANCES[i], value, s)
        if sense * value > sense * before:
            if rises < i:
                return
            rises += 1
        before = value
    if rises == 0:
        table[w + ROUNDS] = MOST_ROUNDS
    elif rises < HALF:
        table[w + VALUES + best + away] = look[rises]
        table[w + SPACING] = DISTANCES[rises] * spacing
        table[w + START] += best * (spacing - table[w + SPACING])
