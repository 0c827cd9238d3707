"""Brackets about the local extremes among evenly spaced values of a channel in a step."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.brackets import (
    BEST,
    BRACKETS,
    CLOSER,
    IN_THIS,
    NARROWING,
    ROUNDS,
    ROW,
    SENSE,
    SPACING,
    START,
    STRIDE,
    VALUES,
)
from jointplay.solver.kernels.loop.extremes.extreme import NODES
from jointplay.solver.kernels.loop.extremes.narrowing import FIRST
from jointplay.solver.kernels.loop.extremes.seeking import is_done
from jointplay.solver.kernels.loop.step import Step

CORNER = 0.5
"""Share of a second difference by which a channel may exceed its values between two of them."""


@inner_kernel(borrows=True)
def open_brackets(
    r: int, step: int, start: float, spacing: float, count: int, sharp: float, waiting: int, s: Step
) -> int:
    """Let local extremes of a channel among `count` values of a step count, if they are sharp.

    The values are where the table has those of a closer look; `start` and `spacing` are shares of
    the step (1: this one, 0: the one before). Returns how many brackets wait to be looked at more
    closely, of all channels.
    """
    table = s.table
    values = table[CLOSER : CLOSER + count]
    least, most, bend = min(values[0], values[1]), max(values[0], values[1]), 0.0
    for i in range(2, count):
        least, most = min(least, values[i]), max(most, values[i])
        bend = max(bend, abs(values[i - 2] - 2.0 * values[i - 1] + values[i]))
    for sense in (1.0, -1.0):
        so_far = s.work[(s.at.highest if sense > 0.0 else s.at.lowest) + r, s.lane]
        if not (most if sense > 0.0 else -least) + CORNER * bend > sense * so_far:
            continue
        for best in range(count):
            if not tops(values, best, sense, so_far):
                continue
            kept = min(max(best - NODES // 2, 0), count - NODES)
            w = BRACKETS + STRIDE * waiting
            table[w + ROW], table[w + SENSE], table[w + IN_THIS] = r, sense, step
            table[w + START], table[w + SPACING] = start + kept * spacing, spacing
            table[w + BEST] = best - kept
            table[w + ROUNDS], table[w + NARROWING] = 0.0, FIRST
            for i in range(NODES):
                table[w + VALUES + i] = values[kept + i]
            if not is_done(w, sharp, s):
                waiting += 1
    return waiting


@inner_kernel()
def tops(values: np.ndarray, i: int, sense: float, so_far: float) -> bool:
    """Whether no value beside one is beyond it, and there may be a new extreme.

    A corner between two values is beyond them by half of the second difference there at most.
    """
    last = len(values) - 1
    here, middle = sense * values[i], min(max(i, 1), last - 1)
    if (i > 0 and sense * values[i - 1] >= here) or (i < last and sense * values[i + 1] > here):
        return False
    bend = abs(values[middle - 1] - 2.0 * values[middle] + values[middle + 1])
    return bool(here + CORNER * bend > sense * so_far)
