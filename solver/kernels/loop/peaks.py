"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

from __future__ import annotations

import numpy as np

from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.extreme import (
    POINTS,
    TIMES,
    VALUES,
    compare_times,
    compare_values,
    extreme,
)
from jointplay.solver.kernels.loop.state import Counter, Setting
from jointplay.solver.kernels.slots import Slot

ONE_OF_EIGHT = 0x0101010101010101
BYTES = 8
"""Rows whose marks are looked at together."""


@kernel()
def refine_peaks(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    marked: np.ndarray,
    counters: np.ndarray,
    settings: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Seek the extremes that the scan suspects around the start of this step.

    Candidate channels are evaluated at quarters of the step before and of this one. `marked` :
    `work`, seen as bytes of the scan. `table` : see `solver.kernels.loop.extreme`.
    """
    since = float(counters[Counter.PERIOD, lane]) * settings[Setting.PERIOD, lane]
    channels_around(work, spare, lane)
    for i in range(LANES):
        table[TIMES + i] = spare[slots[Slot.STAGE_TIME] * LANES + i]
    table[TIMES + POINTS - 1] = work[slots[Slot.ARRIVAL] * LANES + lane]
    compare_times(table)
    first = slots[Slot.MARKED] * LANES
    lanes_bits = np.uint64(ONE_OF_EIGHT << lane)
    for word in range((slots[Slot.ROWS] + BYTES - 1) // BYTES):
        bits = marked[first + word] & lanes_bits
        if bits != 0:
            for r in range(min(BYTES, slots[Slot.ROWS] - BYTES * word)):  # no marks beyond
                if bits >> np.uint64(8 * r + lane) & np.uint64(1):
                    refine(BYTES * word + r, since, lane, slots, work, spare, table)


@kernel()
def refine(
    r: int,
    since: float,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
) -> None:
    """Let the extreme of a channel around the start of this step count, if it is a record."""
    for i in range(LANES):
        table[VALUES + i] = spare[(slots[Slot.CHANNEL] + r) * LANES + i]
    row = r * LANES + lane
    table[VALUES + POINTS - 1] = work[slots[Slot.PREVIOUS] * LANES + row]
    compare_values(table)
    if table[VALUES + LANES // 2] > table[VALUES + 0]:
        time, value = extreme(table, 1.0)
        if value > work[slots[Slot.HIGHEST] * LANES + row]:
            work[slots[Slot.HIGHEST] * LANES + row] = value
            work[slots[Slot.HIGHEST_TIME] * LANES + row] = since + time
    else:
        time, value = extreme(table, -1.0)
        if value < work[slots[Slot.LOWEST] * LANES + row]:
            work[slots[Slot.LOWEST] * LANES + row] = value
            work[slots[Slot.LOWEST_TIME] * LANES + row] = since + time


@kernel()
def end_peaks(lane: int, slots: np.ndarray, work: np.ndarray, now: float) -> None:
    """Let the values at the run's last instant count as extremes."""
    for r in range(slots[Slot.ROWS]):
        row = r * LANES + lane
        value = work[slots[Slot.PREVIOUS] * LANES + row]
        if value > work[slots[Slot.HIGHEST] * LANES + row]:
            work[slots[Slot.HIGHEST] * LANES + row] = value
            work[slots[Slot.HIGHEST_TIME] * LANES + row] = now
        if value < work[slots[Slot.LOWEST] * LANES + row]:
            work[slots[Slot.LOWEST] * LANES + row] = value
            work[slots[Slot.LOWEST_TIME] * LANES + row] = now
