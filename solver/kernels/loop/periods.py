"""Periods, what is due next, and the end of a lane."""

from __future__ import annotations

import math

import numpy as np

from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.clock import product_difference
from jointplay.solver.kernels.loop.state import Counter, SectionKind, Setting, Status
from jointplay.solver.kernels.slots import Slot

SAMPLES, SECTIONS = 0, 1
"""Kinds of rows that fall due at fixed times."""
PACE_STEPS, SLOWEST_PACE = 200_000, 1e-5
"""Fewer periods than SLOWEST_PACE in PACE_STEPS steps are no progress: the run ends."""
SAME = 1e-12
"""Of a period: a section so close to the end of the run is taken there."""
MOST_STEPS = 4e9
"""Accepted steps of one run: days of computing."""


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
    if (
        index >= counters[Counter.SECTIONS, lane]
        or int(settings[Setting.SECTION_KIND, lane]) != SectionKind.CRANK
    ):
        return math.inf
    moment = (float(index) - whole) * period + settings[Setting.SECTION_OFFSET, lane]
    end = work[slots[Slot.END] * LANES + lane]
    return end if abs(moment - end) <= SAME * period else moment


@kernel()
def look_ahead(
    kind: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
) -> None:
    """Note when the next sample or section is due."""
    index = counters[Counter.SAMPLE if kind == SAMPLES else Counter.SECTION, lane]
    due = due_time(kind, index, lane, slots, work, settings, counters)
    settings[Setting.SAMPLE_DUE + kind, lane] = due


@kernel()
def plan(lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray) -> None:
    """Set the next local time at which a lane wants attention."""
    soonest = min(settings[Setting.SAMPLE_DUE, lane], settings[Setting.SECTION_DUE, lane])
    soonest = min(soonest, settings[Setting.PERIOD, lane])
    work[slots[Slot.NEXT_DUE] * LANES + lane] = min(soonest, work[slots[Slot.END] * LANES + lane])


@kernel()
def turn_over(
    lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Begin a new period: local time goes back, and phases on where periods are not common."""
    period = settings[Setting.PERIOD, lane]
    counters[Counter.PERIOD, lane] += 1
    work[slots[Slot.TIME] * LANES + lane] -= period
    work[slots[Slot.BEFORE_TIME] * LANES + lane] -= period
    set_clock(lane, slots, work, settings, counters)
    for kind in range(2):
        look_ahead(kind, lane, slots, work, settings, counters)


@kernel()
def set_clock(
    lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Set the end and the drivers' phases as they are in a lane's present period."""
    whole = float(counters[Counter.PERIOD, lane])
    work[slots[Slot.END] * LANES + lane] = product_difference(
        settings[Setting.DURATION, lane], 1.0, whole, settings[Setting.PERIOD, lane]
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


@kernel()
def check_pace(
    lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray, counters: np.ndarray
) -> None:
    """Stop a lane that has used up its steps or hardly moves; counted in its own steps."""
    period = settings[Setting.PERIOD, lane]
    now = float(counters[Counter.PERIOD, lane]) * period + work[slots[Slot.TIME] * LANES + lane]
    steps = work[slots[Slot.STEPS] * LANES + lane]
    if now - settings[Setting.PACE_TIME, lane] < SLOWEST_PACE * period:
        stop(lane, Status.UNDERFLOW, slots, work, counters)
    elif steps >= MOST_STEPS:
        stop(lane, Status.STEP_LIMIT, slots, work, counters)
    settings[Setting.PACE_TIME, lane] = now
    work[slots[Slot.PACE_AT] * LANES + lane] = steps + PACE_STEPS
