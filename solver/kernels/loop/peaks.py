"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extreme import (
    POINTS,
    TIMES,
    VALUES,
    compare_times,
    compare_values,
    extreme,
)
from jointplay.solver.kernels.loop.runs import Run

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
    since = float(run.periods) * run.period
    channels_around(work, spare, lane)
    for i in range(INSTANTS):
        table[TIMES + i] = spare[at.stage_time, i]
    table[TIMES + POINTS - 1] = work[at.arrival, lane]
    compare_times(table)
    first = at.marked * LANES
    lanes_bits = np.uint64(ONE_OF_EIGHT << lane)
    for word in range((at.rows + BYTES - 1) // BYTES):
        bits = marked[first + word] & lanes_bits
        if bits != 0:
            for r in range(min(BYTES, at.rows - BYTES * word)):  # no marks beyond
                if bits >> np.uint64(8 * r + lane) & np.uint64(1):
                    refine(BYTES * word + r, since, lane, at, work, spare, table)


@kernel()
def refine(
    r: int,
    since: float,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
) -> None:
    """Let the extreme of a channel around the start of this step count, if it is a record."""
    for i in range(INSTANTS):
        table[VALUES + i] = spare[at.channel + r, i]
    table[VALUES + POINTS - 1] = work[at.previous + r, lane]
    compare_values(table)
    if table[VALUES + INSTANTS // 2] > table[VALUES + 0]:
        time, value = extreme(table, 1.0)
        if value > work[at.highest + r, lane]:
            work[at.highest + r, lane] = value
            work[at.highest_time + r, lane] = since + time
    else:
        time, value = extreme(table, -1.0)
        if value < work[at.lowest + r, lane]:
            work[at.lowest + r, lane] = value
            work[at.lowest_time + r, lane] = since + time


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
