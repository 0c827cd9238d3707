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
    l: int,
    slots: np.ndarray,
    work: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
) -> float:
    """Local time of a sample (kind 0) or section (kind 1); infinite past the last one."""
    period = settings[Setting.PERIOD, l]
    whole = float(counters[Counter.PERIOD, l])
    if kind == 0:
        last = counters[Counter.SAMPLES, l] - 1
        if index > last:
            return math.inf
        if index == last:
            return work[slots[Slot.END] * LANES + l]
        return product_difference(float(index), settings[Setting.OUTPUT_STEP, l], whole, period)
    if index >= counters[Counter.SECTIONS, l]:
        return math.inf
    return (float(index) - whole) * period + settings[Setting.SECTION_OFFSET, l]


@kernel()
def plan(
    l: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Set the next local time at which a lane wants attention."""
    sample = due_time(0, counters[Counter.SAMPLE, l], l, slots, work, settings, counters)
    section = due_time(1, counters[Counter.SECTION, l], l, slots, work, settings, counters)
    soonest = min(sample, section)
    soonest = min(soonest, settings[Setting.PERIOD, l])
    work[slots[Slot.NEXT_DUE] * LANES + l] = min(soonest, work[slots[Slot.END] * LANES + l])


@kernel()
def turn_over(
    l: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Begin a new period: local time goes back, and phases on where periods are not common."""
    period = settings[Setting.PERIOD, l]
    counters[Counter.PERIOD, l] += 1
    whole = float(counters[Counter.PERIOD, l])
    work[slots[Slot.TIME] * LANES + l] -= period
    work[slots[Slot.BEFORE_TIME] * LANES + l] -= period
    work[slots[Slot.END] * LANES + l] = product_difference(
        settings[Setting.DURATION, l], 1.0, whole, period
    )
    for k in range(slots[Slot.DRIVERS]):
        start = settings[Setting.FIRST_DRIVER + 2 * k, l]
        travel = whole * settings[Setting.FIRST_DRIVER + 2 * k + 1, l]
        if settings[Setting.TURNING, l] == 0.0:
            work[(slots[Slot.PHASE] + k) * LANES + l] = start + travel
            continue
        turns = travel if settings[Setting.COMMON, l] > 0.0 else math.floor(travel)
        work[(slots[Slot.WOUND] + k) * LANES + l] = 2.0 * math.pi * turns
        work[(slots[Slot.PHASE] + k) * LANES + l] = start + 2.0 * math.pi * (travel - turns)


@kernel()
def stop(l: int, status: int, slots: np.ndarray, work: np.ndarray, counters: np.ndarray) -> None:
    """Take a lane out of the running."""
    counters[Counter.STATUS, l] = status
    work[slots[Slot.ACTIVE] * LANES + l] = 0.0
    work[slots[Slot.ACCEPT] * LANES + l] = 0.0
