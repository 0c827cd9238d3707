"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extreme import (
    MOST_WAITING,
    POINTS,
    SHARES,
    STRIDE,
    TIMES,
    VALUES,
    WAITING,
    compare_times,
    compare_values,
    extreme,
)
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.seeking import HALF, count, is_sharp, seek, time_at

ONE_OF_EIGHT = 0x0101010101010101
BYTES = 8
"""Rows whose marks are looked at together."""


@kernel()
def refine_peaks(
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    marked: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Seek the extremes that the scan suspects around the start of this step.

    Candidate channels are evaluated at quarters of the step before and of this one. `marked` :
    `work`, seen as bytes of the scan. `table` : see `solver.kernels.loop.extreme`.
    """
    look_at_quarters(lane, at, work, spare, table, channels_around)
    waiting = 0
    first = at.marked * LANES
    lanes_bits = np.uint64(ONE_OF_EIGHT << lane)
    for word in range((at.rows + BYTES - 1) // BYTES):
        bits = marked[first + word] & lanes_bits
        if bits != 0:
            for r in range(min(BYTES, at.rows - BYTES * word)):  # no marks beyond
                if bits >> np.uint64(8 * r + lane) & np.uint64(1):
                    row = BYTES * word + r
                    if not refine(row, waiting, lane, run, at, work, spare, table):
                        wait(row, waiting, table)
                        waiting += 1
    for k in range(waiting):
        row = stop_waiting(k, lane, at, work, table)
        sense = 1.0 if table[VALUES + HALF] > table[VALUES] else -1.0
        seek(row, sense, lane, run, at, work, spare, table, channels_around)


@kernel()
def look_at_quarters(
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Evaluate all channels at quarters of the step before and of this one."""
    for i in range(INSTANTS):
        share = i / HALF
        table[SHARES + i] = share
        table[TIMES + i] = time_at(share, lane, at, work)
        spare[at.theta, i] = share - i // HALF
    table[SHARES + INSTANTS] = 2.0
    table[TIMES + INSTANTS] = work[at.tried, lane]
    compare_times(table)
    channels_around(work, spare, lane)


@kernel()
def refine(
    r: int,
    waiting: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
) -> bool:
    """Let the extreme of a channel around the start of this step count; whether it is done with.

    If not, its extreme is not sharp and may be a record; `waiting` others are to be zoomed in on.
    """
    for i in range(INSTANTS):
        table[VALUES + i] = spare[at.channel + r, i]
    table[VALUES + INSTANTS] = work[at.previous + r, lane]
    compare_values(table)
    sense = 1.0 if table[VALUES + HALF] > table[VALUES] else -1.0
    block = at.highest if sense > 0.0 else at.lowest
    time, value, error, best = extreme(table, sense)
    record = work[block + r, lane]
    if waiting < MOST_WAITING and not is_sharp(r, value, error, best, lane, at, work):
        return not sense * value + error > sense * record
    if sense * value > sense * record:
        count(r, sense, value, time, lane, run, at, work)
    return True


@kernel()
def wait(r: int, waiting: int, table: np.ndarray) -> None:
    """Keep the values of a channel until all others were looked at."""
    place = WAITING + STRIDE * waiting
    for i in range(POINTS):
        table[place + i] = table[VALUES + i]
    table[place + POINTS] = r


@kernel()
def stop_waiting(k: int, lane: int, at: Places, work: np.ndarray, table: np.ndarray) -> int:
    """Fill a table with the quarters of two steps and the values that wait at k; the channel."""
    place = WAITING + STRIDE * k
    for i in range(POINTS):
        table[SHARES + i] = i / HALF
        table[TIMES + i] = time_at(table[SHARES + i], lane, at, work)
        table[VALUES + i] = table[place + i]
    compare_times(table)
    compare_values(table)
    return int(table[place + POINTS])


@kernel()
def end_peaks(now: float, lane: int, at: Places, work: np.ndarray) -> None:
    """Let the values at the run's last instant count as extremes."""
    for r in range(at.rows):
        value = work[at.previous + r, lane]
        if value > work[at.highest + r, lane]:
            work[at.highest + r, lane] = value
            work[at.highest_time + r, lane] = now
        if value < work[at.lowest + r, lane]:
            work[at.lowest + r, lane] = value
            work[at.lowest_time + r, lane] = now
