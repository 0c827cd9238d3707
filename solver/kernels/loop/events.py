"""Poincare sections at events: the onset of a contact, or a channel that crosses a value."""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.dense_rows import write_row
from jointplay.solver.kernels.loop.runs import SECTIONS, Run, SectionKind

LEVELS = 14
"""Each narrows the interval of a crossing to an eighth: 2e-13 of the step at the end."""


@kernel()
def any_crossing(runs: np.ndarray) -> bool:
    """Whether a lane takes its sections where a channel crosses a value."""
    found = False
    for lane in range(len(runs)):
        found |= runs[lane].section_kind == SectionKind.CROSSING
    return found


@kernel()
def has_all_events(run: Run) -> bool:
    """Whether a lane with sections at events has as many as it shall have."""
    return run.section_kind != SectionKind.CRANK and run.next[SECTIONS] >= run.stop[SECTIONS]


@kernel()
def record_event(
    i: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    source: np.ndarray,
    rows: np.ndarray,
) -> bool:
    """Write the state in column i of `source` as a section; whether the buffer is full now."""
    begun = float(run.periods) * run.period
    if begun + source[at.stage_time, i] < run.section_from or has_all_events(run):
        return False
    write_row(rows[SECTIONS, lane, run.filled[SECTIONS]], i, lane, run, at, work, source)
    run.filled[SECTIONS] += 1
    run.next[SECTIONS] += 1
    return run.filled[SECTIONS] >= rows.shape[2]


@kernel()
def crosses(lane: int, run: Run, at: Places, work: np.ndarray) -> bool:
    """Whether a lane's channel crosses its value within the step, in the sense that counts."""
    if run.section_kind != SectionKind.CROSSING:
        return False
    before = work[at.previous + run.section_place, lane]
    now = work[at.channel + run.section_place, lane]
    value, sense = run.section_value, run.section_sense
    return sense * (before - value) < 0.0 <= sense * (now - value)


@kernel()
def locate_crossing(
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    channels_within: LaneFunction,
) -> int:
    """Return the column of `spare` that holds the state at the first crossing inside the step."""
    value, sense = run.section_value, run.section_sense
    low, high = 0.0, 1.0
    found = INSTANTS - 1
    for _ in range(LEVELS):
        width = (high - low) / INSTANTS
        for i in range(INSTANTS):
            spare[at.theta, i] = low + width * (i + 1)
        channels_within(work, spare, lane)
        found = INSTANTS - 1
        for i in range(INSTANTS):
            if sense * (spare[at.channel + run.section_place, i] - value) >= 0.0:
                found = i
                break
        low, high = low + width * found, low + width * (found + 1)
    return found
