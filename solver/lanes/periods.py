"""Periods, what is due next, and the end of a lane."""

from __future__ import annotations

import math

import numpy as np

from solver.compiler.layout import LANES
from solver.compiler.slots import Slot
from solver.jit import kernel
from solver.lanes.clock import product_difference
from solver.lanes.state import Counter, Setting

SAMPLES, SECTIONS = 0, 1
"""Kinds of rows that fall due at fixed times."""


@kernel()
def due_time(
    kind: int,
    index: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
) -> float:
    """Local time of a sample (kind 0) or section (kind 1); infinite past the last one."""
    period = settings[Setting.PERIOD, lane]
    whole = float(counters[Counter.PERIOD, lane])
    if kind == 0:
        last = counters[Counter.SAMPLES, lane] - 1
        if index > last:
            return math.inf
        if index == last:
            return work[slots[Slot.END] * LANES + lane]
        return product_difference(float(index), settings[Setting.OUTPUT_STEP, lane], whole, period)
    if index >= counters[Counter.SECTIONS, lane]:
        return math.inf
    return (float(index) - whole) * period + settings[Setting.SECTION_OFFSET, lane]


@kernel()
def plan(
    lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Set the next local time at which a lane wants attention."""
    sample = due_time(0, counters[Counter.SAMPLE, lane], lane, slots, work, settings, counters)
    section = due_time(1, counters[Counter.SECTION, lane], lane, slots, work, settings, counters)
    soonest = min(sample, section)
    soonest = min(soonest, settings[Setting.PERIOD, lane])
    work[slots[Slot.NEXT_DUE] * LANES + lane] = min(soonest, work[slots[Slot.END] * LANES + lane])


@kernel()
def turn_over(
    lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Begin a new period: local time goes back, and phases on where periods are not common."""
    period = settings[Setting.PERIOD, lane]
    counters[Counter.PERIOD, lane] += 1
    whole = float(counters[Counter.PERIOD, lane])
    work[slots[Slot.TIME] * LANES + lane] -= period
    work[slots[Slot.BEFORE_TIME] * LANES + lane] -= period
    work[slots[Slot.END] * LANES + lane] = product_difference(
        settings[Setting.DURATION, lane], 1.0, whole, period
    )
    for k in range(slots[Slot.DRIVERS]):
        start = settings[Setting.FIRST_DRIVER + 2 * k, lane]
        travel = whole * settings[Setting.FIRST_DRIVER + 2 * k + 1, lane]
        if settings[Setting.TURNING, lane] == 0.0:
            work[(slots[Slot.PHASE] + k) * LANES + lane] = start + travel
            continue
        turns = travel if settings[Setting.COMMON, lane] > 0.0 else math.floor(travel)
        work[(slots[Slot.WOUND] + k) * LANES + lane] = 2.0 * math.pi * turns
        work[(slots[Slot.PHASE] + k) * LANES + lane] = start + 2.0 * math.pi * (travel - turns)


@kernel()
def stop(lane: int, status: int, slots: np.ndarray, work: np.ndarray, counters: np.ndarray) -> None:
    """Take a lane out of the running."""
    counters[Counter.STATUS, lane] = status
    work[slots[Slot.ACTIVE] * LANES + lane] = 0.0
    work[slots[Slot.ACCEPT] * LANES + lane] = 0.0
