"""Seeks extremes as `seeking` does, so that a channel's do not depend on which others are sought.

There, brackets of a channel may be narrowed in an order that those of other channels give, and a
extreme that one of them sets decides how sharp the next has to be.
"""

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.brackets import (
    BEST,
    BRACKETS,
    IN_THIS,
    ROUNDS,
    ROW,
    STRIDE,
    VALUES,
)
from jointplay.solver.kernels.loop.seeking import (
    FORETOLD,
    HALF,
    MOST_ROUNDS,
    closer,
    count,
    is_done,
    narrow,
    place_closer,
    rests_at_end,
)
from jointplay.solver.kernels.loop.step import Step, channels_around


@inner_kernel()
def seek_in_turn(waiting: int, s: Step) -> None:
    """Narrow all waiting brackets about their extremes, those of a channel one after the other.

    Brackets of the same nodes are narrowed at once, of each channel the first that is not done.
    """
    table = s.table
    behind = BRACKETS + STRIDE * waiting
    for w in range(BRACKETS, behind, STRIDE):
        if table[w + ROUNDS] < MOST_ROUNDS:
            count_best(w, s)
    for w in range(BRACKETS, behind, STRIDE):
        while table[w + ROUNDS] < MOST_ROUNDS:
            rounds, step = table[w + ROUNDS], table[w + IN_THIS]
            start, spacing, parts = closer(w, table)
            place_closer(start, spacing, parts, HALF * int(step), s)
            channels_around(s)
            before_is_open = False
            for v in range(w, behind, STRIDE):
                of_another_row = v == w or table[v + ROW] != table[v - STRIDE + ROW]
                has_turn = of_another_row or not before_is_open
                before_is_open = table[v + ROUNDS] < MOST_ROUNDS or not has_turn
                if not has_turn or table[v + ROUNDS] != rounds or table[v + IN_THIS] != step:
                    continue
                if v == w or (start, spacing, parts) == closer(v, table):
                    narrow(v, start, spacing, parts, s)
                    if is_done(v, FORETOLD, s) or rests_at_end(v, table):
                        table[v + ROUNDS] = MOST_ROUNDS
                    if table[v + ROUNDS] >= MOST_ROUNDS:
                        count_best(v, s)


@inner_kernel()
def count_best(w: int, s: Step) -> None:
    """Let the best value of a bracket count as it is."""
    best = s.table[w + BEST]
    count(w, best, s.table[w + VALUES + int(best)], s)
