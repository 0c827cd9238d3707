"""Seeks extremes of channels in brackets of a step, more closely until they are sharp.

Brackets of a channel are narrowed one after the other: what one finds decides whether the next one
matters. So the extremes of a channel do not depend on which others are sought.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.brackets import (
    ABSCISSA,
    BENT,
    BEST,
    BRACKETS,
    COLUMN,
    ERROR,
    FOUND,
    IN_THIS,
    MOST_ROUNDS,
    ROUNDS,
    ROW,
    SENSE,
    SPACING,
    START,
    STRIDE,
    VALUE,
    VALUES,
)
from jointplay.solver.kernels.loop.extremes.extreme import LEFT_OUT, extreme, slope_left_out
from jointplay.solver.kernels.loop.extremes.extreme_so_far import count, count_best, spread
from jointplay.solver.kernels.loop.extremes.narrowing import HALF, closer, narrow, place_closer
from jointplay.solver.kernels.loop.extremes.step_ends import is_at_end, look_at_ends
from jointplay.solver.kernels.loop.step import Step, channels_around

SHARP = 2e-7
"""Share of a channel's range up to now to which its extremes are sought."""
FORETOLD = 2e-8
"""The same, of the bound on what a quartic foretells that is not evaluated there."""
LEAST_OFF = 0.1
"""Share of the bound that a quartic's error is taken to be where it happens to be small."""
ULP = 2.0**-52
"""Share of a value that it is rounded by at least."""
ENOUGH_AT_END = 3
"""Rounds after which a best value at the end of a step counts as it is."""


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
    abscissa, value, error, bent = extreme(
        table, w + VALUES, int(table[w + BEST]), sense, so_far, table[w + SPACING]
    )
    if not sense * value + error > sense * so_far:
        return True
    table[w + ABSCISSA], table[w + VALUE], table[w + ERROR] = abscissa, value, error
    table[w + BENT] = bent
    if error > max(sharp * spread(r, value, s), ULP * abs(value)):
        return False
    count(w, table[w + BEST] if bent == 0.0 else abscissa, value, s)
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


@inner_kernel(borrows=True)
def seek(waiting: int, s: Step) -> None:
    """Evaluate the channels of brackets where their extremes seem to be, many at once.

    Mostly that makes them sharp; the others are narrowed until they are, or do not matter.
    """
    if look_where_foretold(waiting, s) > 0:
        look_at_ends(waiting, s)
        narrow_all(waiting, s)


@inner_kernel(borrows=True)
def look_where_foretold(waiting: int, s: Step) -> int:
    """Evaluate the channels of brackets where their extremes seem to be.

    Returns how many are not sharp.
    """
    table, k, unsharp = s.table, 0, 0
    while k < waiting:
        first, early, late = k, 0, HALF
        while k < waiting and early < HALF and late < INSTANTS:
            w = BRACKETS + STRIDE * k
            k += 1
            table[w + COLUMN] = -1.0
            at_node = table[w + ABSCISSA] == np.floor(table[w + ABSCISSA])
            if at_node or table[w + ROUNDS] == MOST_ROUNDS:
                continue
            column = late if table[w + IN_THIS] else early
            early, late = (early, late + 1) if table[w + IN_THIS] else (early + 1, late)
            share = table[w + START] + table[w + ABSCISSA] * table[w + SPACING]
            s.spare[s.at.theta, column] = share
            table[w + COLUMN] = column
        if early > 0 or late > HALF:
            channels_around(s)
        for i in range(first, k):
            w = BRACKETS + STRIDE * i
            column = int(table[w + COLUMN])
            table[w + FOUND] = table[w + VALUES + int(table[w + ABSCISSA])]
            if column >= 0:
                table[w + FOUND] = s.spare[s.at.channel + int(table[w + ROW]), column]
    for i in range(waiting):
        w = BRACKETS + STRIDE * i
        if table[w + ROUNDS] == MOST_ROUNDS:
            continue
        if is_done_by(table[w + FOUND], w, s):
            table[w + ROUNDS] = MOST_ROUNDS
        else:
            count_best(w, s)
            unsharp += 1
    return unsharp


@inner_kernel()
def narrow_all(waiting: int, s: Step) -> None:
    """Narrow brackets that are not done, each together with those of its step that have its nodes.

    Many channels have a kink where a law has one: those of the same nodes are narrowed at once.
    """
    table, behind = s.table, BRACKETS + STRIDE * waiting
    for w in range(BRACKETS, behind, STRIDE):
        while table[w + ROUNDS] < MOST_ROUNDS:
            step, look = table[w + IN_THIS], closer(w, table)
            place_closer(*look, HALF * int(step), s)
            channels_around(s)
            before_is_open = False
            for v in range(w, behind, STRIDE):
                of_another_row = v == w or table[v + ROW] != table[v - STRIDE + ROW]
                has_turn = of_another_row or not before_is_open
                before_is_open = table[v + ROUNDS] < MOST_ROUNDS or not has_turn
                if not has_turn or table[v + ROUNDS] == MOST_ROUNDS or table[v + IN_THIS] != step:
                    continue
                if v == w or look == closer(v, table):
                    has_new_nodes = narrow(v, *look, s)
                    if has_new_nodes and (is_done(v, FORETOLD, s) or rests_at_end(v, table)):
                        table[v + ROUNDS] = MOST_ROUNDS
                    if table[v + ROUNDS] >= MOST_ROUNDS:
                        count_best(v, s)


@inner_kernel()
def rests_at_end(w: int, table: np.ndarray) -> bool:
    """Whether a bracket's best value is still at an end of its step when that was looked at well.

    Beside it there may be a jump: no looking closer would tell more.
    """
    return bool(table[w + ROUNDS] >= ENOUGH_AT_END and is_at_end(w, table))
