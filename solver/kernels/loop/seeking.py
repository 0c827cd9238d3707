"""Seeks the extreme of one channel near some points of two steps, more closely until it is sharp.

Places are shares of two steps: from 0 to 1 of the step before, from 1 to 2 of this one.
"""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extreme import (
    POINTS,
    SHARES,
    TIMES,
    VALUES,
    compare_times,
    compare_values,
    extreme,
)
from jointplay.solver.kernels.loop.runs import Run

HALF = INSTANTS // 2
"""Instants in each of the two steps."""
KEPT = POINTS - HALF
"""Points of a table that stay when it is zoomed in on."""
SHARP = 2e-7
"""Share of a channel's range up to now to which its extremes are sought."""
MOST_ROUNDS = 10
"""Each narrows the place of an extreme to a third."""


@kernel()
def time_at(share: float, lane: int, at: Places, work: np.ndarray) -> float:
    """Return the time at a place in two steps, s since the start of this one."""
    step = work[at.tried, lane] if share >= 1.0 else work[at.before_step, lane]
    return float((share - 1.0) * step)


@kernel()
def seek(
    r: int,
    sense: float,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> bool:
    """Let the extreme near the points of a table count, if it is a record; whether it zoomed in.

    A record is sought more closely until its error is a small share of the range so far.
    """
    block = at.highest if sense > 0.0 else at.lowest
    zoomed = False
    for _ in range(MOST_ROUNDS):
        time, value, error, best = extreme(table, sense)
        record = work[block + r, lane]
        if not sense * value + error > sense * record:
            return zoomed
        if is_sharp(r, value, error, best, lane, at, work):
            break
        zoom(r, best, lane, at, work, spare, table, channels_around)
        zoomed = True
    if sense * value > sense * record:
        count(r, sense, value, time, lane, run, at, work)
    return zoomed


@kernel()
def is_sharp(
    r: int, value: float, error: float, best: int, lane: int, at: Places, work: np.ndarray
) -> bool:
    """Whether an extreme's error is a small share of the channel's range so far, or must do."""
    low = min(work[at.lowest + r, lane], value)
    high = max(work[at.highest + r, lane], value)
    small = not error > SHARP * (high - low) or high - low == np.inf
    return small or best == 0 or best == POINTS - 1


@kernel()
def count(
    r: int,
    sense: float,
    value: float,
    time: float,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
) -> None:
    """Note a record of a channel; `time` is since the start of this step, s."""
    now = float(run.periods) * run.period + work[at.time, lane] + time
    if sense > 0.0:
        work[at.highest + r, lane] = value
        work[at.highest_time + r, lane] = now
    else:
        work[at.lowest + r, lane] = value
        work[at.lowest_time + r, lane] = now


@kernel()
def zoom(
    r: int,
    best: int,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Add four points of channel r to a table, two to either side of its best one.

    Five points about the best one stay.
    """
    first = min(max(best - 2, 0), POINTS - KEPT)
    for i in range(KEPT):  # kept aside behind the table's points
        for row in (SHARES, VALUES):
            table[row + POINTS + i] = table[row + first + i]
    middle = POINTS + best - first
    left, right = table[SHARES + middle - 1], table[SHARES + middle + 1]
    here = table[SHARES + middle]
    for i in range(HALF):
        low, high = (left, here) if i < HALF // 2 else (here, right)
        share = low + (high - low) * (i % 2 + 1) / 3.0
        spare[at.theta, i] = min(share, 1.0)
        spare[at.theta, HALF + i] = max(share - 1.0, 0.0)
    channels_around(work, spare, lane)
    to = 0
    for k in range(POINTS, POINTS + KEPT):
        table[SHARES + to], table[VALUES + to] = table[SHARES + k], table[VALUES + k]
        to += 1
        if k in (middle - 1, middle):
            for i in range(2):
                column = i if k == middle - 1 else 2 + i
                early = table[SHARES + k] < 1.0
                share = spare[at.theta, column] if early else 1.0 + spare[at.theta, HALF + column]
                table[SHARES + to] = share
                table[VALUES + to] = spare[at.channel + r, column if early else HALF + column]
                to += 1
    for i in range(POINTS):
        table[TIMES + i] = time_at(table[SHARES + i], lane, at, work)
    compare_times(table)
    compare_values(table)
