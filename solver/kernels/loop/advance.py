"""Advances lanes, each at its own step, until all are done or Python has something to do.

The generated functions do what all lanes do alike; this loop looks after the lanes that need
attention (`solver.kernels.loop.attention`). Rules that make a run's bits independent of everything
around it: counters are per lane, and only onsets, openings, knots of functions and the end of the
run ever shorten a step.
"""

import numpy as np
from numba import int64

from jointplay.solver.kernels.emit.functions import ADDRESSES, WORK, functions_at
from jointplay.solver.kernels.emit.judging import DUE, INSIDE
from jointplay.solver.kernels.emit.places import PLACES, Places
from jointplay.solver.kernels.jit import LaneFunction, deferred, inner_kernel, kernel
from jointplay.solver.kernels.loop.accepted_steps import write_step
from jointplay.solver.kernels.loop.attention import attend, settle
from jointplay.solver.kernels.loop.bends import (
    any_bend,
    find_in_reach,
    look_between_bends,
    may_pass_bend,
)
from jointplay.solver.kernels.loop.events import (
    any_crossing,
    has_all_events,
    may_cross,
    record_crossings,
)
from jointplay.solver.kernels.loop.inner_peaks import look_at_passages, look_inside
from jointplay.solver.kernels.loop.inner_states import (
    any_may_surpass,
    look_at_inner_states,
)
from jointplay.solver.kernels.loop.peaks import refine_peaks
from jointplay.solver.kernels.loop.roughness import any_due, is_due
from jointplay.solver.kernels.loop.runs import BUFFERS, NO_PAIR, RUNS, Buffers
from jointplay.solver.kernels.loop.unowned_view import unowned


@inner_kernel()
def keep_steps(runs: np.ndarray, at: Places, work: np.ndarray, steps: np.ndarray) -> bool:
    """Write the steps that lanes take which keep them; whether a buffer is full now."""
    full = False
    for lane in range(len(steps)):
        if work[at.accept, lane] > 0.0:
            run = runs[lane]
            write_step(steps[lane, run.kept], lane, run, at, work)
            run.kept += 1
            full |= run.kept == steps.shape[1]
    return full


@kernel()
def count_active(at: Places, work: np.ndarray) -> int:
    """Return how many lanes run."""
    running = 0
    for lane in range(work.shape[1]):
        if work[at.active, lane] > 0.0:
            running += 1
    return running


@inner_kernel()
def any_accepted(at: Places, work: np.ndarray) -> bool:
    """Whether a lane takes the step that was just judged."""
    accepted = 0.0
    for lane in range(work.shape[1]):
        accepted += work[at.accept, lane]
    return accepted > 0.0


@inner_kernel()
def still_landing(runs: np.ndarray) -> bool:
    """Whether a lane is about to land on an onset."""
    landing = 0
    for lane in range(len(runs)):
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
    states_within: LaneFunction,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
    gaps_within: LaneFunction,
) -> None:
    """Seek extremes that no scan of step ends finds."""
    for lane in range(len(runs)):
        flag, run = int(work[at.flag, lane]), runs[lane]
        closely = at.watched_closely or flag & INSIDE or is_due(lane, run, at, work)
        if not work[at.accept, lane] > 0.0:
            continue
        if closely:
            look_at_passages(lane, run, at, work, spare, table, channels_around, channels_within)
        if closely or flag & DUE or run.landing != NO_PAIR:
            look_inside(lane, run, at, work, spare, table, channels_around, channels_within)
        if at.inner_states > 0:
            look_at_inner_states(
                lane,
                run,
                at,
                work,
                spare,
                table,
                states_within,
                channels_around,
                channels_within,
            )
        if may_pass_bend(lane, at, work):
            rows = np.empty(at.rows, np.int64)
            count = find_in_reach(lane, at, work, rows)
            look_between_bends(
                rows[:count],
                0.0,
                1.0,
                lane,
                run,
                at,
                work,
                spare,
                table,
                channels_around,
                channels_within,
                gaps_within,
            )


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
    work : (slots, lanes)
        All quantities of all lanes.
    spare : (slots, INSTANTS)
        Room for instants inside a step of one lane.
    runs : (lanes,)
        Record of each lane's run.
    buffers
        Rows that are handed out.
    watch
        Whether the extremes of channels are sought.

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
            for lane in range(len(runs)):
                flag, run = int(work[at.flag, lane]), runs[lane]
                wanted = flag != 0 or run.landing != NO_PAIR
                if wanted and work[at.active, lane] > 0.0:
                    full |= attend(
                        flag, lane, run, at, work, spare, rows, call.states_within, call.gaps_within
                    )
        if watch or crossing:
            call.observe(work)
        if crossing:
            for lane in range(len(runs)):
                run = runs[lane]
                if work[at.accept, lane] > 0.0 and may_cross(lane, run, at, work):
                    quiet = False
                    full |= record_crossings(lane, run, at, work, spare, rows, call.channels_within)
        if watch and (
            at.watched_closely
            or not quiet
            or any_due(runs, at, work)
            or any_bend(at, work)
            or any_may_surpass(at, work)
        ):
            look_closer(
                at,
                work,
                spare,
                runs,
                table,
                call.states_within,
                call.channels_around,
                call.channels_within,
                call.gaps_within,
            )
        if watch or crossing:  # a scan also keeps the values from which channels go on
            candidates = call.scan(work) if quiet else call.scan_some(work)
            for lane in range(len(runs) if watch and candidates > 0 else 0):
                if candidates >> lane & 1 and work[at.accept, lane] > 0.0:
                    refine_peaks(
                        lane, runs[lane], at, work, spare, marked, table, call.channels_around
                    )
        if watch:
            call.remember(work)
        full |= keep_steps(runs, at, work, steps)
        if tangents and (quiet or any_accepted(at, work)):
            call.tangent_step(work)
        call.take(work)
        if quiet and not full:
            continue
        for lane in range(len(runs)):
            flag, run = int(work[at.flag, lane]), runs[lane]
            wanted = flag != 0 or run.landing != NO_PAIR or has_all_events(run)
            if wanted and work[at.accept, lane] > 0.0:
                full |= settle(
                    flag,
                    lane,
                    run,
                    at,
                    work,
                    buffers,
                    call.weigh,
                    call.right_hand_side,
                    call.tangent_gaps,
                )
        still = count_active(at, work)
        landing = still_landing(runs)
        if full or still < running:  # a free lane may have a new problem waiting
            break
        running = still
    return made
