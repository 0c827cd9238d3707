"""Advances eight lanes, each at its own step, until all are done or it is time to look up.

The generated functions do what all lanes do alike; this loop looks after the lanes that need
attention: a rejected step, a contact that begins or ends, a sample or section that is due, the
end of a period or of the run. Rules that make a run's bits independent of everything around it:
counters are per lane, and only onsets, openings and the end of the run ever shorten a step.
"""

from __future__ import annotations

import math

import numpy as np
from numba import float64, int64, types, void

from jointplay.solver.kernels.jit import LaneFunction, deferred, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.contacts import (
    CAUTIOUS,
    begin_contact,
    end_contact,
    is_touching,
    land,
)
from jointplay.solver.kernels.loop.events import (
    any_crossing,
    crosses,
    has_all_events,
    locate_crossing,
    record_event,
)
from jointplay.solver.kernels.loop.openings import LATE, end_behind_opening, note_openings
from jointplay.solver.kernels.loop.peaks import end_peaks, refine_peaks
from jointplay.solver.kernels.loop.periods import check_pace, plan, stop, turn_over
from jointplay.solver.kernels.loop.rows import emit
from jointplay.solver.kernels.loop.state import Counter, SectionKind, Setting, Status
from jointplay.solver.kernels.loop.tangent import latch_tangent, record_growth
from jointplay.solver.kernels.loop.unowned_view import borrowed
from jointplay.solver.kernels.slots import Slot

LANE_FUNCTION = types.FunctionType(void(float64[::1]))
FLAG_FUNCTION = types.FunctionType(float64(float64[::1]))
ROWS_FUNCTION = types.FunctionType(int64(float64[::1]))
ONE_LANE_FUNCTION = types.FunctionType(void(float64[::1], float64[::1], int64))
REJECTED, DUE, ONSET, RELEASE, PACE = 1, 2, 4, 8, 16
"""What a lane's flag is the sum of; see `solver.kernels.emit.judging`."""


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
    states_within: LaneFunction,
    gaps_within: LaneFunction,
) -> bool:
    """Look after one lane between its attempt and its commit; whether a buffer is full."""
    opening = 1.0
    if flag & RELEASE:
        opening = note_openings(lane, slots, work, spare, gaps_within)
    if flag & REJECTED:
        counters[Counter.REJECTIONS, lane] += 1
        counters[Counter.LANDING, lane] = -1  # its attempts count on, or they might go in circles
        if work[slots[Slot.NEXT_STEP] * LANES + lane] < settings[Setting.SMALLEST_STEP, lane]:
            stop(lane, Status.UNDERFLOW, slots, work, counters)
            return False
        if is_touching(lane, slots, work):
            work[slots[Slot.NEXT_STEP] * LANES + lane] *= CAUTIOUS
    if opening < LATE:
        end_behind_opening(opening, lane, slots, work, counters)
        return False
    if flag & REJECTED:
        return False
    if flag & ONSET or counters[Counter.LANDING, lane] >= 0:
        landed = land(lane, slots, work, spare, counters, gaps_within)
        if not landed:
            work[slots[Slot.ACCEPT] * LANES + lane] = 0.0
            return False
    if flag & DUE:
        return emit(
            lane, slots, work, spare, settings, counters, sample_rows, section_rows, states_within
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
    section_rows: np.ndarray,
    impact_rows: np.ndarray,
    growth_rows: np.ndarray,
    weigh: LaneFunction,
    tangent_gaps: LaneFunction,
) -> bool:
    """Look after one lane once its step is taken; whether a buffer is nearly full."""
    tangents = growth_rows.shape[1] > 0
    period = settings[Setting.PERIOD, lane]
    begun = float(counters[Counter.PERIOD, lane]) * period
    now = begun + work[slots[Slot.TIME] * LANES + lane]
    full = False
    landed = counters[Counter.LANDING, lane]
    if landed >= 0:
        begin_contact(landed, now, lane, slots, work)
        weigh(work)  # where a fixed step ends, a contact may begin deep: with energy from nowhere
        stored = work[slots[Slot.STORED] * LANES + lane]
        work[slots[Slot.STORED_START] * LANES + lane] = stored
        if tangents:
            tangent_gaps(work)
            latch_tangent(landed, lane, slots, work)
        counters[Counter.ONSETS, lane] += 1
        counters[Counter.LANDING, lane] = -1
        counters[Counter.LANDINGS, lane] = 0
        if (
            int(settings[Setting.SECTION_KIND, lane]) == SectionKind.ONSET
            and int(settings[Setting.SECTION_PLACE, lane]) == landed
        ):
            full |= record_event(
                lane, lane, slots, work, work, settings, counters, section_rows
            )  # fmt: skip
    if flag & RELEASE:
        for j in range(slots[Slot.JOINTS]):
            opened = work[(slots[Slot.OPENED] + j) * LANES + lane]
            if work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0 and opened < math.inf:
                work[(slots[Slot.MODE] + j) * LANES + lane] = 0.0
                end_contact(j, begun + opened, lane, slots, work, counters, impact_rows)
        full |= counters[Counter.IMPACT_ROWS, lane] + slots[Slot.JOINTS] > impact_rows.shape[1]
    over = work[slots[Slot.TIME] * LANES + lane] >= work[slots[Slot.END] * LANES + lane]
    if over or has_all_events(lane, settings, counters):
        end_peaks(lane, slots, work, now)
        if tangents:
            full |= record_growth(now, lane, slots, work, counters, growth_rows)
        for j in range(slots[Slot.JOINTS]):
            if work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0:
                end_contact(j, math.nan, lane, slots, work, counters, impact_rows)
        stop(lane, Status.DONE, slots, work, counters)
        return full
    if flag & PACE:
        check_pace(lane, slots, work, settings, counters)
    if flag & DUE:
        if work[slots[Slot.TIME] * LANES + lane] >= period:
            turn_over(lane, slots, work, settings, counters)
            if tangents:
                full |= record_growth(now, lane, slots, work, counters, growth_rows)
        plan(lane, slots, work, settings)
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
def any_accepted(slots: np.ndarray, work: np.ndarray) -> bool:
    """Whether a lane takes the step that was just judged."""
    accepted = 0.0
    for lane in range(LANES):
        accepted += work[slots[Slot.ACCEPT] * LANES + lane]
    return accepted > 0.0


@kernel()
def still_landing(counters: np.ndarray) -> bool:
    """Whether a lane is about to land on an onset."""
    landing = 0
    for lane in range(LANES):
        if counters[Counter.LANDING, lane] >= 0:
            landing += 1
    return landing > 0


ROWS = float64[:, :, ::1]


@deferred(
    int64(
        FLAG_FUNCTION,
        *[LANE_FUNCTION] * 4,
        *[ROWS_FUNCTION] * 2,
        *[ONE_LANE_FUNCTION] * 4,
        *[LANE_FUNCTION] * 2,
        int64[::1],
        *[float64[::1]] * 2,
        float64[:, ::1],
        int64[:, ::1],
        float64[::1],
        *[ROWS] * 4,
        int64,
        int64,
    )
)
def advance(
    attempt: LaneFunction,
    remember: LaneFunction,
    take: LaneFunction,
    weigh: LaneFunction,
    observe: LaneFunction,
    scan: LaneFunction,
    scan_some: LaneFunction,
    states_within: LaneFunction,
    gaps_within: LaneFunction,
    channels_within: LaneFunction,
    channels_around: LaneFunction,
    tangent_step: LaneFunction,
    tangent_gaps: LaneFunction,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    settings: np.ndarray,
    counters: np.ndarray,
    table: np.ndarray,
    sample_rows: np.ndarray,
    section_rows: np.ndarray,
    impact_rows: np.ndarray,
    growth_rows: np.ndarray,
    watch: int,
    budget: int,
) -> int:
    """Make at most `budget` attempts at a step; fewer if a lane ends or a buffer is full.

    Parameters
    ----------
    attempt, remember, take, weigh, observe, scan, scan_some
    states_within, gaps_within, channels_within, channels_around
        `Kernel.functions`, typed as first-class functions, so that this loop is compiled once.
    tangent_step, tangent_gaps
        `Tangents.functions`; not called where `growth_rows` has no room.
    slots
        Where quantities live in `work` and `spare`, both (slots * LANES,).
    settings, counters
        (kinds, LANES): see `solver.kernels.loop.state`.
    table
        See `solver.kernels.loop.extreme`.
    sample_rows, section_rows : (LANES, capacity, width)
        Dense states at samples and sections; `solver.kernels.loop.state.row_width` gives the width.
    impact_rows : (LANES, capacity, 6)
        Contacts that ended: joint, onset, release, approach rate, peak force, impulse.
    growth_rows : (LANES, capacity, 2)
        Growth of tangents: end of its time, logarithm. Without capacity there are no tangents.
    watch
        Whether the extremes of channels are sought; sections at crossings need it, too.

    Returns
    -------
    int
        How many attempts were made.
    """
    work, spare, slots = borrowed(work), borrowed(spare), borrowed(slots)
    settings, counters = borrowed(settings), borrowed(counters)
    table, marked = borrowed(table), borrowed(work.view(np.uint64))
    running = count_active(slots, work)
    landing = still_landing(counters)
    crossing = any_crossing(settings)
    tangents = growth_rows.shape[1] > 0
    made = 0
    while made < budget and running > 0:
        made += 1
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
                        sample_rows, section_rows, states_within, gaps_within,
                    )  # fmt: skip
        if watch:
            observe(work)
        if crossing:
            for lane in range(LANES):
                if work[slots[Slot.ACCEPT] * LANES + lane] > 0.0 and crosses(
                    lane, slots, work, settings
                ):
                    quiet = False
                    found = locate_crossing(lane, slots, work, spare, settings, channels_within)
                    full |= record_event(
                        found, lane, slots, work, spare, settings, counters, section_rows
                    )
        if watch:
            candidates = scan(work) if quiet else scan_some(work)
            for lane in range(LANES if candidates > 0 else 0):
                if candidates >> lane & 1 and work[slots[Slot.ACCEPT] * LANES + lane] > 0.0:
                    refine_peaks(
                        lane, slots, work, spare, marked, counters, settings, table, channels_around
                    )
            remember(work)
        if tangents and (quiet or any_accepted(slots, work)):
            tangent_step(work)
        take(work)
        if quiet:
            continue
        for lane in range(LANES):
            if work[slots[Slot.ACCEPT] * LANES + lane] == 0.0:
                continue
            flag = int(work[slots[Slot.FLAG] * LANES + lane])
            if (
                flag != 0
                or counters[Counter.LANDING, lane] >= 0
                or has_all_events(lane, settings, counters)
            ):
                full |= settle(
                    flag, lane, slots, work, settings, counters,
                    section_rows, impact_rows, growth_rows, weigh, tangent_gaps,
                )  # fmt: skip
        still = count_active(slots, work)
        landing = still_landing(counters)
        if full or still < running:  # a free lane may have a new problem waiting
            break
        running = still
    return made
