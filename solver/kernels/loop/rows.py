"""Rows of dense state: what samples and sections are made of."""

from __future__ import annotations

import numpy as np

from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.periods import SAMPLES, due_time
from jointplay.solver.kernels.loop.state import Counter, Setting
from jointplay.solver.kernels.slots import Slot


@kernel()
def write_row(
    row: np.ndarray,
    i: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    counters: np.ndarray,
) -> None:
    """Write the dense state in lane i of `spare`: period, time, phases, state, modes, rates."""
    row[0] = counters[Counter.PERIOD, lane]
    row[1] = spare[slots[Slot.STAGE_TIME] * LANES + i]
    at = 2
    for k in range(2 * slots[Slot.DRIVERS]):  # phases, then whole turns
        row[at + k] = work[(slots[Slot.PHASE] + k) * LANES + lane]
    at += 2 * slots[Slot.DRIVERS]
    for k in range(slots[Slot.STATES]):
        row[at + k] = spare[(slots[Slot.STAGE] + k) * LANES + i]
    at += slots[Slot.STATES]
    for k in range(slots[Slot.JOINTS]):
        row[at + 2 * k] = spare[(slots[Slot.MODE] + k) * LANES + i]
        row[at + 2 * k + 1] = spare[(slots[Slot.IMPACT_RATE] + k) * LANES + i]


@kernel()
def emit(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    states_within: LaneFunction,
) -> bool:
    """Write the samples and sections inside this step; whether a buffer was too full for them.

    A full buffer postpones the step: the same attempt is made again once there is room.
    """
    arrival = work[slots[Slot.ARRIVAL] * LANES + lane]
    start, tried = work[slots[Slot.TIME] * LANES + lane], work[slots[Slot.TRIED] * LANES + lane]
    for kind in range(2):
        rows = sample_rows if kind == SAMPLES else section_rows
        next_index = Counter.SAMPLE if kind == SAMPLES else Counter.SECTION
        filled = Counter.SAMPLE_ROWS if kind == SAMPLES else Counter.SECTION_ROWS
        while settings[Setting.SAMPLE_DUE + kind, lane] <= arrival:
            count = 0
            moment = settings[Setting.SAMPLE_DUE + kind, lane]
            while count < LANES and moment <= arrival:
                theta = (moment - start) / tried if tried > 0.0 else 0.0
                spare[slots[Slot.THETA] * LANES + count] = min(max(theta, 0.0), 1.0)
                count += 1
                moment = due_time(kind, counters[next_index, lane] + count, lane, slots, work,
                                  settings, counters)  # fmt: skip
            if counters[filled, lane] + count > rows.shape[1]:
                work[slots[Slot.ACCEPT] * LANES + lane] = 0.0
                work[slots[Slot.NEXT_STEP] * LANES + lane] = work[slots[Slot.STEP] * LANES + lane]
                return True
            states_within(work, spare, lane)
            for i in range(count):
                write_row(rows[lane, counters[filled, lane]], i, lane, slots, work, spare, counters)
                counters[filled, lane] += 1
            counters[next_index, lane] += count
            settings[Setting.SAMPLE_DUE + kind, lane] = moment
    return False
