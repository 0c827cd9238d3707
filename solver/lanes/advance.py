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
from solver.compiler.slots import Slot
from solver.jit import LaneFunction, deferred, kernel
from solver.lanes.borrowed import borrowed
from solver.lanes.contacts import begin_contact, end_contact, land, note_openings
from solver.lanes.peaks import end_peaks, refine_peaks
from solver.lanes.periods import plan, stop, turn_over
from solver.lanes.rows import emit
from solver.lanes.state import Counter, Setting, Status

LANE_FUNCTION = types.FunctionType(void(float64[::1]))
FLAG_FUNCTION = types.FunctionType(float64(float64[::1]))
PROBE_FUNCTION = types.FunctionType(void(float64[::1], float64[::1], int64))
REJECTED, DUE, ONSET, RELEASE = 1, 2, 4, 8
"""What a lane's flag is the sum of; see `solver.compiler.stepping`."""


@kernel()
def attend(
    flag: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    lend: LaneFunction,
    probe: LaneFunction,
    right_hand_side: LaneFunction,
) -> bool:
    """Look after one lane between its attempt and its commit; whether a buffer is full."""
    if flag & REJECTED:
        counters[Counter.REJECTIONS, lane] += 1
        counters[Counter.LANDING, lane] = -1
        counters[Counter.LANDINGS, lane] = 0
        if work[slots[Slot.NEXT_STEP] * LANES + lane] < settings[Setting.SMALLEST_STEP, lane]:
            stop(lane, Status.UNDERFLOW, slots, work, counters)
        return False
    if flag & ONSET or counters[Counter.LANDING, lane] >= 0:
        landed = land(lane, slots, work, spare, counters, lend, probe, right_hand_side)
        if not landed:
            work[slots[Slot.ACCEPT] * LANES + lane] = 0.0
            return False
    if flag & RELEASE:
        note_openings(lane, slots, work)
    if flag & DUE:
        return emit(
            lane, slots, work, spare, settings, counters, sample_rows, section_rows, probe
        )  # fmt: skip
    return False


@kernel()
def settle(
    flag: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    impact_rows: np.ndarray,
) -> bool:
    """Look after one lane once its step is taken; whether the impact buffer is nearly full."""
    period = settings[Setting.PERIOD, lane]
    begun = float(counters[Counter.PERIOD, lane]) * period
    now = begun + work[slots[Slot.TIME] * LANES + lane]
    full = False
    landed = counters[Counter.LANDING, lane]
    if landed >= 0:
        begin_contact(landed, now, lane, slots, work)
        counters[Counter.ONSETS, lane] += 1
        counters[Counter.LANDING, lane] = -1
        counters[Counter.LANDINGS, lane] = 0
    if flag & RELEASE:
        for j in range(slots[Slot.JOINTS]):
            gap = work[(slots[Slot.GAP] + 4 * j) * LANES + lane]
            rate = work[(slots[Slot.GAP] + 4 * j + 1) * LANES + lane]
            if work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0 and gap <= 0.0 and rate < 0.0:
                work[(slots[Slot.MODE] + j) * LANES + lane] = 0.0
                opened = begun + work[(slots[Slot.OPENED] + j) * LANES + lane]
                end_contact(j, opened, lane, slots, work, counters, impact_rows)
        full = counters[Counter.IMPACT_ROWS, lane] + slots[Slot.JOINTS] > impact_rows.shape[1]
    if flag & DUE:
        if work[slots[Slot.TIME] * LANES + lane] >= work[slots[Slot.END] * LANES + lane]:
            end_peaks(lane, slots, work, now)
            for j in range(slots[Slot.JOINTS]):
                if work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0:
                    end_contact(j, math.nan, lane, slots, work, counters, impact_rows)
            stop(lane, Status.DONE, slots, work, counters)
            return full
        if work[slots[Slot.TIME] * LANES + lane] >= period:
            turn_over(lane, slots, work, settings, counters)
        plan(lane, slots, work, settings, counters)
    return full


@kernel()
def count_active(slots: np.ndarray, work: np.ndarray) -> int:
    """Return how many lanes run."""
    running = 0
    for lane in range(LANES):
        if work[slots[Slot.ACTIVE] * LANES + lane] > 0.0:
            running += 1
    return running


@kernel()
def still_landing(counters: np.ndarray) -> bool:
    """Whether a lane is about to land on an onset."""
    landing = 0
    for lane in range(LANES):
        if counters[Counter.LANDING, lane] >= 0:
            landing += 1
    return landing > 0


@kernel()
def copy_lane(source: np.ndarray, target: np.ndarray, held: np.ndarray, lane: int) -> None:
    """Copy the slots that a lane keeps when its step is not taken."""
    for i in range(len(held)):
        place = held[i] * LANES + lane
        target[place] = source[place]


TABLE, ROWS = float64[:, ::1], float64[:, :, ::1]


@deferred(
    int64(
        FLAG_FUNCTION,
        *[LANE_FUNCTION] * 4,
        FLAG_FUNCTION,
        *[PROBE_FUNCTION] * 3,
        int64[::1],
        int64[::1],
        *[float64[::1]] * 3,
        TABLE,
        int64[:, ::1],
        TABLE,
        *[ROWS] * 3,
        int64,
    )
)
def advance(
    attempt: LaneFunction,
    keep: LaneFunction,
    commit: LaneFunction,
    right_hand_side: LaneFunction,
    observe: LaneFunction,
    scan: LaneFunction,
    lend: LaneFunction,
    probe: LaneFunction,
    probe_around: LaneFunction,
    slots: np.ndarray,
    held: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    store: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    scratch: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    impact_rows: np.ndarray,
    budget: int,
) -> int:
    """Make at most `budget` attempts at a step.

    Parameters
    ----------
    attempt, keep, commit, right_hand_side, observe, scan, lend, probe, probe_around
        `Kernel.functions`, typed as first-class functions, so that this loop is compiled once.
    slots
        Where quantities live in `work`, `spare` and `store`, all (slots * LANES,).
    held
        Slots of `work` that wait in `store` while a lane's step is not taken.
    settings, counters
        (kinds, LANES): see `solver.lanes.state`.
    scratch : (rows + 1, POINTS + 1)
        See `solver.lanes.peaks`.
    sample_rows, section_rows : (LANES, capacity, width)
        Dense states at samples and sections; `solver.lanes.state.row_width` gives the width.
    impact_rows : (LANES, capacity, 6)
        Contacts that ended: joint, onset, release, approach rate, peak force, impulse.

    Returns
    -------
    int
        How many lanes still run.
    """
    work, spare, slots = borrowed(work), borrowed(spare), borrowed(slots)
    settings, counters = borrowed(settings), borrowed(counters)
    scratch = borrowed(scratch)
    held, store = borrowed(held), borrowed(store)
    running = count_active(slots, work)
    landing = still_landing(counters)
    for _ in range(budget):
        if running == 0:
            break
        flags = attempt(work)
        quiet = flags == 0.0 and not landing
        full = False
        if not quiet:
            for lane in range(LANES):
                flag = int(work[slots[Slot.FLAG] * LANES + lane])
                if work[slots[Slot.ACTIVE] * LANES + lane] > 0.0 and (
                    flag != 0 or counters[Counter.LANDING, lane] >= 0
                ):
                    full |= attend(
                        flag, lane, slots, work, spare, settings, counters,
                        sample_rows, section_rows, lend, probe, right_hand_side,
                    )  # fmt: skip
                if work[slots[Slot.ACCEPT] * LANES + lane] == 0.0:
                    copy_lane(work, store, held, lane)
        observe(work)
        if scan(work) > 0.0:
            for lane in range(LANES):
                if (
                    work[slots[Slot.PEAK] * LANES + lane] > 0.0
                    and work[slots[Slot.ACCEPT] * LANES + lane] > 0.0
                ):
                    refine_peaks(
                        lane, slots, work, spare, counters, settings, scratch,
                        lend, probe_around, right_hand_side, observe,
                    )  # fmt: skip
        keep(work)
        commit(work)
        if quiet:
            continue
        for lane in range(LANES):
            if work[slots[Slot.ACCEPT] * LANES + lane] == 0.0:
                copy_lane(store, work, held, lane)
                continue
            flag = int(work[slots[Slot.FLAG] * LANES + lane])
            if flag != 0 or counters[Counter.LANDING, lane] >= 0:
                full |= settle(flag, lane, slots, work, settings, counters, impact_rows)
        running = count_active(slots, work)
        landing = still_landing(counters)
        if full:
            break
    return running
