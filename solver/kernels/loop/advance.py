"""Advances lanes, each at its own step, until all are done or Python has something to do.

The generated functions do what all lanes do alike; this loop looks after the lanes that need
attention: a rejected step, a contact that begins or ends, a sample or section that is due, the
end of a period or of the run. Rules that make a run's bits independent of everything around it:
counters are per lane, and only onsets, openings and the end of the run ever shorten a step.
"""

import math

import numpy as np
from numba import int64

from jointplay.solver.kernels.emit.functions import (
    ADDRESSES,
    WORK,
    functions_at,
)
from jointplay.solver.kernels.emit.judging import DUE, ONSET, PACE, PASSING, REJECTED, RELEASE
from jointplay.solver.kernels.emit.places import PLACES, Places
from jointplay.solver.kernels.jit import LaneFunction, deferred, inner_kernel, kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.loop.accepted_steps import write_step
from jointplay.solver.kernels.loop.contacts import (
    CAUTIOUS,
    begin_contact,
    end_contact,
    is_touching,
    land,
    lands_beside,
)
from jointplay.solver.kernels.loop.dense_rows import hand_out
from jointplay.solver.kernels.loop.events import (
    any_crossing,
    has_all_events,
    may_cross,
    record_crossings,
    record_event,
)
from jointplay.solver.kernels.loop.inner_peaks import look_at_passages, look_inside
from jointplay.solver.kernels.loop.openings import LATE, end_behind_opening, note_openings
from jointplay.solver.kernels.loop.peaks import end_peaks, refine_peaks
from jointplay.solver.kernels.loop.periods import check_pace, plan, stop, turn_over
from jointplay.solver.kernels.loop.roughness import any_due, is_due
from jointplay.solver.kernels.loop.runs import (
    BUFFERS,
    NO_PAIR,
    RUNS,
    Buffers,
    Run,
    SectionKind,
    Status,
)
from jointplay.solver.kernels.loop.tangent import latch_tangent, record_growth
from jointplay.solver.kernels.loop.unowned_view import unowned

KEEPING = 0
"""Lane whose accepted steps are kept, if any are."""


@inner_kernel()
def attend(
    flag: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    rows: np.ndarray,
    states_within: LaneFunction,
    gaps_within: LaneFunction,
) -> bool:
    """Look after one lane between its attempt and its commit; whether a buffer is full."""
    opening = 1.0
    if flag & RELEASE:
        opening = note_openings(lane, at, work, spare, gaps_within)
    if flag & REJECTED:
        run.rejections += 1
        run.landing = NO_PAIR  # its attempts count on, or they might go in circles
        if work[at.next_step, lane] < run.smallest_step:
            stop(Status.UNDERFLOW, lane, run, at, work)
            return False
        if is_touching(lane, at, work):
            work[at.next_step, lane] *= CAUTIOUS
    if opening < LATE:
        end_behind_opening(opening, lane, run, at, work)
        return False
    if flag & REJECTED:
        return False
    if flag & ONSET or run.landing != NO_PAIR:
        landed = land(lane, run, at, work, spare, gaps_within)
        if not landed:
            work[at.accept, lane] = 0.0
            return False
    if flag & DUE:
        return hand_out(lane, run, at, work, spare, rows, states_within)
    return False


@inner_kernel()
def settle(
    flag: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    buffers: Buffers,
    weigh: LaneFunction,
    tangent_gaps: LaneFunction,
) -> bool:
    """Look after one lane once its step is taken; whether a buffer is nearly full."""
    tangents = buffers.growths.shape[1] > 0
    begun = float(run.periods) * run.period
    now = begun + work[at.time, lane]
    full = False
    landed = run.landing
    if landed != NO_PAIR:
        for j in range(at.pairs):
            if j != landed and not lands_beside(j, lane, at, work):
                continue
            begin_contact(j, now, lane, at, work)
            weigh(work)  # where a fixed step ends, one may begin deep: with energy from nowhere
            work[at.stored_start, lane] = work[at.stored, lane]
            if tangents:
                tangent_gaps(work)
                latch_tangent(j, lane, at, work)
            run.onsets += 1
            if run.section_kind == SectionKind.ONSET and run.section_place == j:
                full |= record_event(lane, lane, run, at, work, work, buffers.rows)
        run.landing = NO_PAIR
        run.landings = 0
    if flag & RELEASE:
        for j in range(at.pairs):
            opened = work[at.opened + j, lane]
            if work[at.mode + j, lane] > 0.0 and opened < math.inf:
                work[at.mode + j, lane] = 0.0
                end_contact(j, begun + opened, lane, run, at, work, buffers.impacts)
        full |= run.impacts + at.pairs > buffers.impacts.shape[1]
    if work[at.time, lane] >= work[at.end, lane] or has_all_events(run):
        end_peaks(now, lane, at, work)
        if tangents:
            full |= record_growth(now, lane, run, at, work, buffers.growths)
        for j in range(at.pairs):
            if work[at.mode + j, lane] > 0.0:
                end_contact(j, math.nan, lane, run, at, work, buffers.impacts)
        stop(Status.DONE, lane, run, at, work)
        return full
    if flag & PACE:
        check_pace(lane, run, at, work)
    if flag & DUE:
        if work[at.time, lane] >= run.period:
            turn_over(lane, run, at, work)
            if tangents:
                full |= record_growth(now, lane, run, at, work, buffers.growths)
        plan(lane, run, at, work)
    return full


@inner_kernel()
def keep_step(run: Run, at: Places, work: np.ndarray, steps: np.ndarray) -> bool:
    """Write the step that the lane that keeps them takes; whether the buffer is full now."""
    if len(steps) == 0 or not work[at.accept, KEEPING] > 0.0:
        return False
    write_step(steps[run.kept], KEEPING, run, at, work)
    run.kept += 1
    return run.kept == len(steps)


@kernel()
def count_active(at: Places, work: np.ndarray) -> int:
    """Return how many lanes run."""
    running = 0
    for lane in range(LANES):
        if work[at.active, lane] > 0.0:
            running += 1
    return running


@inner_kernel()
def any_accepted(at: Places, work: np.ndarray) -> bool:
    """Whether a lane takes the step that was just judged."""
    accepted = 0.0
    for lane in range(LANES):
        accepted += work[at.accept, lane]
    return accepted > 0.0


@inner_kernel()
def still_landing(runs: np.ndarray) -> bool:
    """Whether a lane is about to land on an onset."""
    landing = 0
    for lane in range(LANES):
        if runs[lane].landing != NO_PAIR:
            landing += 1
    return landing > 0


@inner_kernel()
def look_closer(
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    runs: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
) -> None:
    """Seek extremes that no scan of step ends finds."""
    for lane in range(LANES):
        flag, run = int(work[at.flag, lane]), runs[lane]
        due = flag & (PASSING | DUE) or is_due(lane, run, at, work)
        if (at.watched_closely or due) and work[at.accept, lane] > 0.0:
            look_at_passages(lane, run, at, work, spare, table, channels_around, channels_within)
            look_inside(lane, run, at, work, spare, table, channels_around, channels_within)


@deferred(int64(ADDRESSES, PLACES, WORK, WORK, RUNS, BUFFERS, int64, int64))
def advance(
    addresses: np.ndarray,
    places: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    runs: np.ndarray,
    buffers: Buffers,
    watch: int,
    budget: int,
) -> int:
    """Make at most `budget` attempts at a step; fewer if a lane ends or a buffer is full.

    Parameters
    ----------
    addresses
        Of the kernel's functions, by name; those of tangents are not called where `buffers` has
        no room for growths.
    places
        Where quantities are in `work` and `spare`: one `Places`, in kernels called `at`.
    work : (slots, LANES)
        All quantities of all lanes.
    spare : (slots, INSTANTS)
        Room for instants inside a step of one lane.
    runs : (LANES,)
        Record of each lane's run.
    buffers
        Rows that are handed out.
    watch
        Whether the extremes of channels are sought; sections at crossings need it, too.

    Returns
    -------
    int
        How many attempts were made.
    """
    call, at = functions_at(addresses[0]), places[0]
    work, spare, runs = unowned(work), unowned(spare), unowned(runs)
    table, marked = unowned(buffers.table), unowned(work.reshape(work.size).view(np.uint64))
    rows, steps = unowned(buffers.rows), unowned(buffers.steps)
    running = count_active(at, work)
    landing = still_landing(runs)
    crossing = any_crossing(runs)
    tangents = buffers.growths.shape[1] > 0
    made = 0
    while made < budget and running > 0:
        made += 1
        flags = call.attempt(work)
        quiet = flags == 0.0 and not landing
        full = False
        if not quiet:
            for lane in range(LANES):
                flag, run = int(work[at.flag, lane]), runs[lane]
                wanted = flag != 0 or run.landing != NO_PAIR
                if wanted and work[at.active, lane] > 0.0:
                    full |= attend(
                        flag, lane, run, at, work, spare, rows, call.states_within, call.gaps_within
                    )
        if watch:
            call.observe(work)
        if crossing:
            for lane in range(LANES):
                run = runs[lane]
                if work[at.accept, lane] > 0.0 and may_cross(lane, run, at, work):
                    quiet = False
                    full |= record_crossings(lane, run, at, work, spare, rows, call.channels_within)
        if watch and (at.watched_closely or not quiet or any_due(runs, at, work)):
            look_closer(at, work, spare, runs, table, call.channels_around, call.channels_within)
        if watch:
            candidates = call.scan(work) if quiet else call.scan_some(work)
            for lane in range(LANES if candidates > 0 else 0):
                if candidates >> lane & 1 and work[at.accept, lane] > 0.0:
                    refine_peaks(
                        lane, runs[lane], at, work, spare, marked, table, call.channels_around
                    )
            call.remember(work)
        full |= keep_step(runs[KEEPING], at, work, steps)
        if tangents and (quiet or any_accepted(at, work)):
            call.tangent_step(work)
        call.take(work)
        if quiet and not full:
            continue
        for lane in range(LANES):
            flag, run = int(work[at.flag, lane]), runs[lane]
            wanted = flag != 0 or run.landing != NO_PAIR or has_all_events(run)
            if wanted and work[at.accept, lane] > 0.0:
                full |= settle(flag, lane, run, at, work, buffers, call.weigh, call.tangent_gaps)
        still = count_active(at, work)
        landing = still_landing(runs)
        if full or still < running:  # a free lane may have a new problem waiting
            break
        running = still
    return made
