"""Extremes of friction's own states, such as bristles, inside steps.

Bristles that slide are stiff: an explicit method's steps are as long as is stable, and their
deflection swings inside by the error that a step may make, whatever the motion does, and while
apart, too. The slopes at both ends of a step tell how far.
"""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.inner_peaks import place_evenly
from jointplay.solver.kernels.loop.looks_into_steps import look_at_suspects
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.seeking import SHARP
from jointplay.solver.kernels.loop.tops import CORNER
from jointplay.solver.kernels.record.rows import NO_ROW


@inner_kernel()
def may_surpass(k: int, lane: int, at: Places, work: np.ndarray) -> bool:
    """Whether inner state `k` may have a record inside the step, beyond what a look is worth."""
    row = int(work[at.inner_row + k, lane])
    if row == NO_ROW:
        return False
    before, now = work[at.previous + row, lane], work[at.channel + row, lane]
    lowest, highest = work[at.lowest + row, lane], work[at.highest + row, lane]
    i = 2 * at.step_row.coordinates + k
    slopes = abs(work[at.k1_ + i, lane]) + abs(work[at.slope + i, lane])
    reach = work[at.tried, lane] * slopes - SHARP * (highest - lowest)
    return bool(max(before, now) + reach > highest or min(before, now) - reach < lowest)


@inner_kernel()
def any_may_surpass(at: Places, work: np.ndarray) -> bool:
    """Whether an inner state in any lane may have a record in the step that it takes."""
    for lane in range(work.shape[1] if at.inner_states > 0 else 0):
        if work[at.accept, lane] > 0.0:
            for k in range(at.inner_states):
                if may_surpass(k, lane, at, work):
                    return True
    return False


@inner_kernel()
def surpasses(k: int, lane: int, at: Places, work: np.ndarray, spare: np.ndarray) -> bool:
    """Whether inner state `k`, known at even instants, may have a record worth a look."""
    row = int(work[at.inner_row + k, lane])
    values = spare[at.stage + 2 * at.step_row.coordinates + k]
    least, most, bend = values[0], values[0], 0.0
    for i in range(1, INSTANTS):
        least, most = min(least, values[i]), max(most, values[i])
        if i > 1:
            bend = max(bend, abs(values[i - 2] - 2.0 * values[i - 1] + values[i]))
    lowest, highest = work[at.lowest + row, lane], work[at.highest + row, lane]
    beyond = CORNER * bend - SHARP * (highest - lowest)
    return bool(most + beyond > highest or least - beyond < lowest)


@inner_kernel()
def look_at_inner_states(
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    states_within: LaneFunction,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
) -> None:
    """Seek extremes of inner states inside the step."""
    rows, count, placed = np.empty(at.inner_states, np.int64), 0, False
    for k in range(at.inner_states):
        if not may_surpass(k, lane, at, work):
            continue
        if not placed:
            place_evenly(0.0, 1.0, at, spare)
            states_within(work, spare, lane)
            placed = True
        if surpasses(k, lane, at, work, spare):
            rows[count] = int(work[at.inner_row + k, lane])
            count += 1
    if count > 0:
        channels_within(work, spare, lane)
        look_at_suspects(rows[:count], 0.0, 1.0, lane, run, at, work, spare, table, channels_around)
