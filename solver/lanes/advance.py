"""Advances eight lanes, each at its own step, until all are done or it is time to look up.

The generated functions do what all lanes do alike; this loop looks after the lanes that need
attention: a rejected step, a contact that begins or ends, a sample or section that is due, the
end of a period or of the run. Rules that make a run's bits independent of everything around it:
counters are per lane, and only onsets and the end of the run ever shorten a step.
"""

from __future__ import annotations

import math

import numpy as np
from numba import float64, int64, types, void

from solver.compiler.layout import LANES
from solver.compiler.slots import Slots
from solver.jit import kernel
from solver.lanes.contacts import begin_contact, end_contact, land
from solver.lanes.peaks import end_peaks, refine_peaks
from solver.lanes.periods import plan, stop, turn_over
from solver.lanes.rows import emit
from solver.lanes.state import Counter, Setting, Status

LANE_FUNCTION = types.FunctionType(void(float64[::1]))
PROBE_FUNCTION = types.FunctionType(void(float64[::1], float64[::1], int64))
REJECTED, DUE, ONSET, RELEASE = 1, 2, 4, 8
"""What a lane's flag is the sum of; see `solver.compiler.stepping`."""


@kernel()
def attend(
    flag: int,
    l: int,
    slots: Slots,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    probe: object,
    right_hand_side: object,
) -> bool:
    """Look after one lane between its attempt and its commit; whether a buffer is full."""
    if flag & REJECTED:
        counters[Counter.REJECTIONS, l] += 1
        counters[Counter.LANDING, l] = -1
        counters[Counter.LANDINGS, l] = 0
        if work[slots.next_step * LANES + l] < settings[Setting.SMALLEST_STEP, l]:
            stop(l, Status.UNDERFLOW, slots, work, counters)
        return False
    if flag & ONSET or counters[Counter.LANDING, l] >= 0:
        landed = land(l, slots, work, spare, settings, counters, probe, right_hand_side)
        if not landed:
            work[slots.accept * LANES + l] = 0.0
            return False
    if flag & DUE:
        return emit(
            l, slots, work, spare, settings, counters, sample_rows, section_rows, probe
        )  # fmt: skip
    return False


@kernel()
def settle(
    flag: int,
    l: int,
    slots: Slots,
    work: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    impact_rows: np.ndarray,
) -> bool:
    """Look after one lane once its step is taken; whether the impact buffer is nearly full."""
    period = settings[Setting.PERIOD, l]
    now = float(counters[Counter.PERIOD, l]) * period + work[slots.time * LANES + l]
    full = False
    landed = counters[Counter.LANDING, l]
    if landed >= 0:
        begin_contact(landed, now, l, slots, work)
        counters[Counter.ONSETS, l] += 1
        counters[Counter.LANDING, l] = -1
        counters[Counter.LANDINGS, l] = 0
    if flag & RELEASE:
        for j in range(slots.joints):
            gap = work[(slots.gap + 4 * j) * LANES + l]
            rate = work[(slots.gap + 4 * j + 1) * LANES + l]
            if work[(slots.mode + j) * LANES + l] > 0.0 and gap <= 0.0 and rate < 0.0:
                work[(slots.mode + j) * LANES + l] = 0.0
                end_contact(j, now, l, slots, work, counters, impact_rows)
        full = counters[Counter.IMPACT_ROWS, l] + slots.joints > impact_rows.shape[1]
    if flag & DUE:
        if work[slots.time * LANES + l] >= work[slots.end * LANES + l]:
            end_peaks(l, slots, work, now)
            for j in range(slots.joints):
                if work[(slots.mode + j) * LANES + l] > 0.0:
                    end_contact(j, math.nan, l, slots, work, counters, impact_rows)
            stop(l, Status.DONE, slots, work, counters)
            return full
        if work[slots.time * LANES + l] >= period:
            turn_over(l, slots, work, settings, counters)
        plan(l, slots, work, settings, counters)
    return full


SLOTS = types.NamedUniTuple(int64, len(Slots._fields), Slots)
TABLE, ROWS = float64[:, ::1], float64[:, :, ::1]


@kernel(
    int64(
        *[LANE_FUNCTION] * 7,
        *[PROBE_FUNCTION] * 2,
        SLOTS,
        *[float64[::1]] * 2,
        TABLE,
        int64[:, ::1],
        *[ROWS] * 3,
        int64,
    )
)
def advance(
    attempt: object,
    keep: object,
    commit: object,
    right_hand_side: object,
    observe: object,
    scan: object,
    advance_scan: object,
    probe: object,
    probe_before: object,
    slots: Slots,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    impact_rows: np.ndarray,
    budget: int,
) -> int:
    """Make at most `budget` attempts at a step.

    Parameters
    ----------
    attempt, keep, commit, right_hand_side, observe, scan, advance_scan, probe, probe_before
        `Kernel.functions`, typed as first-class functions, so that this loop is compiled once.
    slots
        Where quantities live in `work` and `spare`, both (slots * LANES,).
    settings, counters
        (kinds, LANES): see `solver.lanes`.
    sample_rows, section_rows : (LANES, capacity, width)
        Dense states at samples and sections; `solver.lanes.row_width` gives the width.
    impact_rows : (LANES, capacity, 6)
        Contacts that ended: joint, onset, release, approach rate, peak force, impulse.

    Returns
    -------
    int
        How many lanes still run.
    """
    mask_value = np.full(LANES, -1.0)
    for _ in range(budget):
        running = 0
        for l in range(LANES):
            if work[slots.active * LANES + l] > 0.0:
                running += 1
        if running == 0:
            return 0
        attempt(work)
        full = False
        for l in range(LANES):
            flag = int(work[slots.flag * LANES + l])
            if flag == 0 and counters[Counter.LANDING, l] < 0:
                continue
            if work[slots.active * LANES + l] == 0.0:
                continue
            full |= attend(
                flag, l, slots, work, spare, settings, counters,
                sample_rows, section_rows, probe, right_hand_side,
            )  # fmt: skip
        observe(work)
        scan(work)
        changed = False
        for l in range(LANES):
            accept = work[slots.accept * LANES + l]
            changed |= accept != mask_value[l]
            mask_value[l] = accept
            if accept > 0.0 and work[slots.peak * LANES + l] > 0.0:
                refine_peaks(
                    l, slots, work, spare, counters, settings,
                    probe, probe_before, right_hand_side, observe,
                )  # fmt: skip
        if changed:
            for i in range(slots.mask_rows):
                for l in range(LANES):
                    work[(slots.mask + i) * LANES + l] = mask_value[l]
        keep(work)
        advance_scan(work)
        commit(work)
        for l in range(LANES):
            if mask_value[l] > 0.0:
                counters[Counter.STEPS, l] += 1
                tried = work[slots.tried * LANES + l]
                if tried < settings[Setting.SMALLEST_SEEN, l]:
                    settings[Setting.SMALLEST_SEEN, l] = tried
                flag = int(work[slots.flag * LANES + l])
                if flag != 0 or counters[Counter.LANDING, l] >= 0:
                    full |= settle(flag, l, slots, work, settings, counters, impact_rows)
                if counters[Counter.STEPS, l] >= counters[Counter.MOST_STEPS, l]:
                    stop(l, Status.STEP_LIMIT, slots, work, counters)
        if full:
            break
    running = 0
    for l in range(LANES):
        if work[slots.active * LANES + l] > 0.0:
            running += 1
    return running
