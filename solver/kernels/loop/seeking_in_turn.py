"""Seeks extremes as `seeking` does, so that a channel's do not depend on which others are sought.

There, windows of a channel may be narrowed in an order that those of other channels give, and a
record that one of them sets decides how sharp the next has to be.
"""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, inner_kernel
from jointplay.solver.kernels.loop.runs import Run
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
from jointplay.solver.kernels.loop.windows import (
    BEST,
    IN_THIS,
    ROUNDS,
    ROW,
    STRIDE,
    VALUES,
    WINDOWS,
)


@inner_kernel()
def seek_in_turn(
    waiting: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Narrow all waiting windows about their extremes, those of a channel one after the other.

    Windows of the same places are narrowed at once, of each channel the first that is not done.
    """
    behind = WINDOWS + STRIDE * waiting
    for w in range(WINDOWS, behind, STRIDE):
        if table[w + ROUNDS] < MOST_ROUNDS:
            count_best(w, lane, run, at, work, table)
    for w in range(WINDOWS, behind, STRIDE):
        while table[w + ROUNDS] < MOST_ROUNDS:
            rounds, step = table[w + ROUNDS], table[w + IN_THIS]
            start, spacing, parts = closer(w, table)
            place_closer(start, spacing, parts, HALF * int(step), at, spare)
            channels_around(work, spare, lane)
            before_is_open = False
            for v in range(w, behind, STRIDE):
                of_another_row = v == w or table[v + ROW] != table[v - STRIDE + ROW]
                has_turn = of_another_row or not before_is_open
                before_is_open = table[v + ROUNDS] < MOST_ROUNDS or not has_turn
                if not has_turn or table[v + ROUNDS] != rounds or table[v + IN_THIS] != step:
                    continue
                if v == w or (start, spacing, parts) == closer(v, table):
                    narrow(v, start, spacing, parts, at, spare, table)
                    if is_done(v, FORETOLD, lane, run, at, work, table) or rests_at_end(v, table):
                        table[v + ROUNDS] = MOST_ROUNDS
                    if table[v + ROUNDS] >= MOST_ROUNDS:
                        count_best(v, lane, run, at, work, table)


@inner_kernel()
def count_best(
    w: int, lane: int, run: Run, at: Places, work: np.ndarray, table: np.ndarray
) -> None:
    """Let the best value of a window count as it is."""
    best = table[w + BEST]
    count(w, best, table[w + VALUES + int(best)], lane, run, at, work, table)
