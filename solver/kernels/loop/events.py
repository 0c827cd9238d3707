"""Poincare sections at events: the onset of a contact, or a channel that crosses a value."""

from __future__ import annotations

import numpy as np

from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.rows import write_row
from jointplay.solver.kernels.loop.state import Counter, SectionKind, Setting
from jointplay.solver.kernels.slots import Slot

LEVELS = 14
"""Each narrows the interval of a crossing to an eighth: 2e-13 of the step at the end."""


@kernel()
def any_crossing(settings: np.ndarray) -> bool:
    """Whether a lane takes its sections where a channel crosses a value."""
    found = False
    for lane in range(LANES):
        found |= int(settings[Setting.SECTION_KIND, lane]) == SectionKind.CROSSING
    return found


@kernel()
def has_all_events(lane: int, settings: np.ndarray, counters: np.ndarray) -> bool:
    """Whether a lane with sections at events has as many as it shall have."""
    return (
        int(settings[Setting.SECTION_KIND, lane]) != SectionKind.CRANK
        and counters[Counter.SECTION, lane] >= counters[Counter.SECTIONS, lane]
    )


@kernel()
def record_event(
    i: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    source: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    section_rows: np.ndarray,
) -> bool:
    """Write the state in lane i of `source` as a section; whether the buffer is full now."""
    begun = float(counters[Counter.PERIOD, lane]) * settings[Setting.PERIOD, lane]
    at = begun + source[slots[Slot.STAGE_TIME] * LANES + i]
    if at < settings[Setting.SECTION_FROM, lane] or has_all_events(lane, settings, counters):
        return False
    row = section_rows[lane, counters[Counter.SECTION_ROWS, lane]]
    write_row(row, i, lane, slots, work, source, counters)
    counters[Counter.SECTION_ROWS, lane] += 1
    counters[Counter.SECTION, lane] += 1
    return counters[Counter.SECTION_ROWS, lane] >= section_rows.shape[1]


@kernel()
def crosses(lane: int, slots: np.ndarray, work: np.ndarray, settings: np.ndarray) -> bool:
    """Whether a lane's channel crosses its value within the step, in the sense that counts."""
    if int(settings[Setting.SECTION_KIND, lane]) != SectionKind.CROSSING:
        return False
    row = int(settings[Setting.SECTION_PLACE, lane])
    value, sense = settings[Setting.SECTION_VALUE, lane], settings[Setting.SECTION_SENSE, lane]
    before = work[(slots[Slot.PREVIOUS] + row) * LANES + lane]
    now = work[(slots[Slot.CHANNEL] + row) * LANES + lane]
    return sense * (before - value) < 0.0 <= sense * (now - value)


@kernel()
def locate_crossing(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    channels_within: LaneFunction,
) -> int:
    """Return the lane of `spare` that holds the state at the first crossing inside the step."""
    row = int(settings[Setting.SECTION_PLACE, lane])
    value, sense = settings[Setting.SECTION_VALUE, lane], settings[Setting.SECTION_SENSE, lane]
    low, high = 0.0, 1.0
    found = LANES - 1
    for _ in range(LEVELS):
        width = (high - low) / LANES
        for i in range(LANES):
            spare[slots[Slot.THETA] * LANES + i] = low + width * (i + 1)
        channels_within(work, spare, lane)
        found = LANES - 1
        for i in range(LANES):
            if sense * (spare[(slots[Slot.CHANNEL] + row) * LANES + i] - value) >= 0.0:
                found = i
                break
        low, high = low + width * found, low + width * (found + 1)
    return found
