"""Extremes of channels in parts of stored steps, sought as those of a run are."""

import numpy as np
from numba import float64, int64, void

from jointplay.solver.kernels.emit.functions import ADDRESSES, WORK, functions_at
from jointplay.solver.kernels.emit.places import PLACES, Places
from jointplay.solver.kernels.jit import LaneFunction, deferred, inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.accepted_steps import read_steps
from jointplay.solver.kernels.loop.bin_records import (
    HIGHEST,
    HIGHEST_TIME,
    LOWEST,
    LOWEST_TIME,
    count_smooth,
    find_suspects,
    widen,
)
from jointplay.solver.kernels.loop.inner_peaks import WIDTHS, place_evenly
from jointplay.solver.kernels.loop.passages import NARROWEST, closest_approach, passes
from jointplay.solver.kernels.loop.peaks import look_at_extremes
from jointplay.solver.kernels.loop.runs import RUNS, Run
from jointplay.solver.kernels.loop.tops import open_windows
from jointplay.solver.kernels.loop.unowned_view import unowned
from jointplay.solver.kernels.loop.windows import CLOSER

MOTION = 6
"""Numbers of a journal's motion: place, rate, acceleration."""


@inner_kernel()
def remember_start(lane: int, at: Places, work: np.ndarray) -> None:
    """Keep gaps and journals' motion as they are where the step starts: the stage is there."""
    for j in range(at.pairs):
        work[at.gap_start + j, lane] = work[at.gap + j, lane]
        work[at.gap_rate_start + j, lane] = work[at.gap_rate + j, lane]
    for k in range(MOTION * at.pairs):
        work[at.eccentricity_start + k, lane] = work[at.eccentricity + k, lane]


@inner_kernel()
def load_records(
    chosen: np.ndarray,
    watched: np.ndarray,
    ranges: np.ndarray,
    records: np.ndarray,
    lane: int,
    at: Places,
    work: np.ndarray,
) -> None:
    """Set a lane's records of chosen channels to those that a bin has, and their ranges."""
    for c in chosen:
        work[at.known_range + watched[c], lane] = ranges[c]
        work[at.lowest + watched[c], lane] = records[c, LOWEST]
        work[at.lowest_time + watched[c], lane] = records[c, LOWEST_TIME]
        work[at.highest + watched[c], lane] = records[c, HIGHEST]
        work[at.highest_time + watched[c], lane] = records[c, HIGHEST_TIME]


@inner_kernel()
def store_records(
    chosen: np.ndarray,
    watched: np.ndarray,
    records: np.ndarray,
    lane: int,
    at: Places,
    work: np.ndarray,
) -> None:
    """Set a bin's records, (channels, 4), to those that a lane has of chosen channels."""
    for c in chosen:
        records[c, LOWEST] = work[at.lowest + watched[c], lane]
        records[c, LOWEST_TIME] = work[at.lowest_time + watched[c], lane]
        records[c, HIGHEST] = work[at.highest + watched[c], lane]
        records[c, HIGHEST_TIME] = work[at.highest_time + watched[c], lane]


@inner_kernel()
def any_passes(lane: int, at: Places, work: np.ndarray) -> bool:
    """Whether a journal passes the centre of its bearing in this step."""
    found = False
    for j in range(at.pairs):
        found |= passes(j, lane, at, work)
    return found


@inner_kernel()
def look_at_suspects(
    chosen: np.ndarray,
    watched: np.ndarray,
    sharp: float,
    low: float,
    high: float,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
) -> None:
    """Seek extremes of chosen channels that are known at even instants between two shares."""
    waiting, spacing = 0, (high - low) / (INSTANTS - 1)
    for c in chosen:
        r = watched[c]
        table[CLOSER : CLOSER + INSTANTS] = spare[at.channel + r]
        waiting = open_windows(
            r, 1, low, spacing, INSTANTS, sharp, waiting, lane, run, at, work, table
        )
    look_at_extremes(waiting, lane, run, at, work, spare, table, channels_around)


@inner_kernel()
def look_about_passages(
    every: np.ndarray,
    watched: np.ndarray,
    sharp: float,
    low: float,
    high: float,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
) -> None:
    """Seek extremes where journals pass the centres of their bearings, between two shares."""
    for j in range(at.pairs):
        if passes(j, lane, at, work):
            share, width = closest_approach(j, lane, at, work)
            left, right = max(share - WIDTHS * width, low), min(share + WIDTHS * width, high)
            if left < right - NARROWEST:
                place_evenly(left, right, at, spare)
                channels_within(work, spare, lane)
                look_at_suspects(
                    every,
                    watched,
                    sharp,
                    left,
                    right,
                    lane,
                    run,
                    at,
                    work,
                    spare,
                    table,
                    channels_around,
                )


@deferred(
    void(
        *(ADDRESSES, PLACES, WORK, WORK, RUNS, float64[::1], float64[:, ::1], int64[:, ::1]),
        *(float64[:, ::1], int64[::1], int64[::1], float64[::1], float64, float64[:, :, ::1]),
    )
)
def extremes_in_steps(
    addresses: np.ndarray,
    places: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    runs: np.ndarray,
    table: np.ndarray,
    steps: np.ndarray,
    parts: np.ndarray,
    shares: np.ndarray,
    watched: np.ndarray,
    rest: np.ndarray,
    ranges: np.ndarray,
    sharp: float,
    records: np.ndarray,
) -> None:
    """Seek extremes of channels in parts of steps, and keep those of each bin.

    Parameters
    ----------
    work, spare, runs
        As `states_in_steps` takes them.
    table
        See `solver.kernels.loop.windows`.
    steps : (n, width)
        Consecutive steps, as `write_step` wrote them.
    parts : (k, 2)
        Step and bin of each part, both ascending; every step has a part.
    shares : (k, 2)
        Where in its step a part begins and ends.
    watched : (w,)
        Rows of the channel block that runs watch for extremes.
    rest : (r,)
        Rows of the others, which are functions of time alone.
    ranges : (w + r,)
        Range of each channel in its run, as far as it is known: extremes are sharp against that.
        Those of bins that are complete widen it.
    sharp
        Share of its range by which an extreme may be off unseen; 0: it is evaluated where it is.
    records : (bins, w + r, 4)
        Lowest value, its time, highest value, its time; NaN where there is none yet.
    """
    call, at = functions_at(addresses[0]), places[0]
    work, spare, runs, table = unowned(work), unowned(spare), unowned(runs), unowned(table)
    every, suspects = np.arange(len(watched)), np.empty(len(watched), np.int64)
    around, within = call.channels_around, call.channels_within
    p = 0
    for first in range(0, len(steps), LANES):
        count = read_steps(steps, first, runs, at, work)
        call.right_hand_side(work)
        for lane in range(LANES):
            remember_start(lane, at, work)
        call.attempt(work)
        while p < len(parts) and parts[p, 0] < first + count:
            if p > 0 and parts[p - 1, 1] != parts[p, 1]:
                widen(ranges, records[parts[p - 1, 1]])
            lane, record = parts[p, 0] - first, records[parts[p, 1]]
            run, tried = runs[lane], work[at.tried, lane]
            low, high = shares[p, 0], shares[p, 1]
            begun = float(run.periods) * run.period + work[at.time, lane] + low * tried
            place_evenly(low, high, at, spare)
            within(work, spare, lane)
            spacing = (high - low) * tried / (INSTANTS - 1)
            count_smooth(rest, record[len(watched) :], begun, spacing, at, spare)
            behind = find_suspects(
                watched, ranges, sharp, begun, spacing, record, at, spare, suspects
            )
            chosen = every if any_passes(lane, at, work) else suspects[:behind]
            load_records(chosen, watched, ranges, record, lane, at, work)
            look_at_suspects(
                chosen, watched, sharp, low, high, lane, run, at, work, spare, table, around
            )
            look_about_passages(
                every, watched, sharp, low, high, lane, run, at, work, spare, table, around, within
            )
            store_records(chosen, watched, record, lane, at, work)
            p += 1
