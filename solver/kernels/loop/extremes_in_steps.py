"""Extremes of channels in parts of stored steps, sought as those of a run are."""

import numpy as np
from numba import float64, int64, void

from jointplay.solver.kernels.emit.functions import ADDRESSES, WORK, functions_at
from jointplay.solver.kernels.emit.places import PLACES, Places
from jointplay.solver.kernels.jit import LaneFunction, deferred, inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.accepted_steps import read_steps
from jointplay.solver.kernels.loop.book import (
    HIGHEST,
    HIGHEST_TIME,
    LOWEST,
    LOWEST_TIME,
    RANGE,
    close_bin,
    write_bin,
)
from jointplay.solver.kernels.loop.inner_peaks import WIDTHS, place_evenly
from jointplay.solver.kernels.loop.passages import NARROWEST, closest_approach, passes
from jointplay.solver.kernels.loop.peaks import look_where_foretold
from jointplay.solver.kernels.loop.runs import RUNS, Run
from jointplay.solver.kernels.loop.seeking_in_turn import seek_in_turn
from jointplay.solver.kernels.loop.suspects import find_suspects
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
    chosen: np.ndarray, book: np.ndarray, lane: int, at: Places, work: np.ndarray
) -> None:
    """Set a lane's records of chosen rows to those of a book, and their ranges."""
    for r in chosen:
        work[at.known_range + r, lane] = book[RANGE, r]
        work[at.lowest + r, lane] = book[LOWEST, r]
        work[at.lowest_time + r, lane] = book[LOWEST_TIME, r]
        work[at.highest + r, lane] = book[HIGHEST, r]
        work[at.highest_time + r, lane] = book[HIGHEST_TIME, r]


@inner_kernel()
def store_records(
    chosen: np.ndarray, book: np.ndarray, lane: int, at: Places, work: np.ndarray
) -> None:
    """Set a book's records to those that a lane has of chosen rows."""
    for r in chosen:
        book[LOWEST, r] = work[at.lowest + r, lane]
        book[LOWEST_TIME, r] = work[at.lowest_time + r, lane]
        book[HIGHEST, r] = work[at.highest + r, lane]
        book[HIGHEST_TIME, r] = work[at.highest_time + r, lane]


@inner_kernel()
def any_passes(lane: int, at: Places, work: np.ndarray) -> bool:
    """Whether a journal passes the centre of its bearing in this step."""
    found = False
    for j in range(at.pairs):
        found |= passes(j, lane, at, work)
    return found


@inner_kernel()
def eights(rows: np.ndarray) -> np.ndarray:
    """Return the first row of each eight that one of ascending rows is in."""
    found, count = np.empty(len(rows), np.int64), 0
    for r in rows:
        first = r - r % INSTANTS
        if count == 0 or found[count - 1] != first:
            found[count] = first
            count += 1
    return found[:count]


@inner_kernel()
def look_at_suspects(
    chosen: np.ndarray,
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
    """Seek extremes of chosen rows that are known at even instants between two shares."""
    waiting, spacing = 0, (high - low) / (INSTANTS - 1)
    for r in chosen:
        table[CLOSER : CLOSER + INSTANTS] = spare[at.channel + r]
        waiting = open_windows(
            r, 1, low, spacing, INSTANTS, sharp, waiting, lane, run, at, work, table
        )
    if look_where_foretold(waiting, lane, run, at, work, spare, table, channels_around) > 0:
        seek_in_turn(waiting, lane, run, at, work, spare, table, channels_around)


@inner_kernel()
def look_about_passages(
    every: np.ndarray,
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
        *(float64[:, ::1], int64[::1], float64, float64[:, ::1], float64[:, :, ::1]),
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
    rows: np.ndarray,
    sharp: float,
    book: np.ndarray,
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
    rows : (channels,)
        Rows of the channel block that are wanted, ascending.
    sharp
        Share of its range by which an extreme may be off unseen; 0: it is evaluated where it is.
    book
        See `solver.kernels.loop.book`: of bin 0 so far, then of the last one.
    records : (bins, channels, 4)
        Lowest value, its time, highest value, its time; left as it is where a bin has no part.
    """
    call, at = functions_at(addresses[0]), places[0]
    work, spare, runs, table = unowned(work), unowned(spare), unowned(runs), unowned(table)
    book, close = unowned(book), np.empty(spare.shape)
    every, suspects = rows[rows < at.rows], np.empty(book.shape[1], np.int64)
    blocks = eights(rows)
    around, within = call.channels_around, call.channels_within
    p, present = 0, 0
    for first in range(0, len(steps), LANES):
        count = read_steps(steps, first, runs, at, work)
        call.right_hand_side(work)
        for lane in range(LANES):
            remember_start(lane, at, work)
        call.attempt(work)
        while p < len(parts) and parts[p, 0] < first + count:
            if parts[p, 1] != present:
                close_bin(book, rows, records[present])
                present = parts[p, 1]
            lane = parts[p, 0] - first
            run, tried = runs[lane], work[at.tried, lane]
            low, high = shares[p, 0], shares[p, 1]
            begin = float(run.periods) * run.period + work[at.time, lane] + low * tried
            spacing = (high - low) * tried / (INSTANTS - 1)
            place_evenly(low, high, at, spare)
            within(work, spare, lane)
            behind = find_suspects(
                low,
                high,
                begin,
                spacing,
                sharp,
                blocks,
                lane,
                at,
                work,
                spare,
                close,
                table,
                book,
                within,
                suspects,
            )
            passing = any_passes(lane, at, work)
            chosen = every if passing else suspects[:behind]
            if len(chosen) > 0:
                load_records(chosen, book, lane, at, work)
                look_at_suspects(
                    chosen, sharp, low, high, lane, run, at, work, spare, table, around
                )
                if passing:
                    look_about_passages(
                        every, sharp, low, high, lane, run, at, work, spare, table, around, within
                    )
                store_records(chosen, book, lane, at, work)
            p += 1
    write_bin(book, rows, records[present])
