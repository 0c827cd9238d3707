"""Extremes of channels in parts of stored steps, sought as those of a run are."""

import math

import numpy as np
from numba import float64, int64, void

from jointplay.solver.kernels.emit.functions import ADDRESSES, WORK, functions_at
from jointplay.solver.kernels.emit.places import PLACES, Places
from jointplay.solver.kernels.jit import LaneFunction, deferred, inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.accepted_steps import read_step
from jointplay.solver.kernels.loop.inner_peaks import WIDTHS, look_at_instants, place_evenly
from jointplay.solver.kernels.loop.passages import NARROWEST, closest_approach, passes
from jointplay.solver.kernels.loop.peaks import look_at_extremes
from jointplay.solver.kernels.loop.runs import RUNS, Run
from jointplay.solver.kernels.loop.unowned_view import unowned

LOWEST, LOWEST_TIME, HIGHEST, HIGHEST_TIME = range(4)
"""Columns of a record."""
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
    rows: np.ndarray, records: np.ndarray, lane: int, at: Places, work: np.ndarray
) -> None:
    """Set a lane's records of channels to those that a bin has, (channels, 4)."""
    for c in range(len(rows)):
        if rows[c] < at.rows:
            work[at.lowest + rows[c], lane] = records[c, LOWEST]
            work[at.lowest_time + rows[c], lane] = records[c, LOWEST_TIME]
            work[at.highest + rows[c], lane] = records[c, HIGHEST]
            work[at.highest_time + rows[c], lane] = records[c, HIGHEST_TIME]


@inner_kernel()
def store_records(
    rows: np.ndarray, records: np.ndarray, lane: int, at: Places, work: np.ndarray
) -> None:
    """Set a bin's records, (channels, 4), to those that a lane has."""
    for c in range(len(rows)):
        if rows[c] < at.rows:
            records[c, LOWEST] = work[at.lowest + rows[c], lane]
            records[c, LOWEST_TIME] = work[at.lowest_time + rows[c], lane]
            records[c, HIGHEST] = work[at.highest + rows[c], lane]
            records[c, HIGHEST_TIME] = work[at.highest_time + rows[c], lane]


@inner_kernel()
def count_smooth(record: np.ndarray, values: np.ndarray, begun: float, spacing: float) -> None:
    """Let extremes of a function of time alone count, known at even instants: by parabolas.

    record : (4,); begun : time of the first instant, s; spacing : between instants, s.
    """
    last = len(values) - 1
    for i in range(last + 1):
        value, time = values[i], begun + spacing * i
        if 0 < i < last:
            rise, fall = values[i] - values[i - 1], values[i] - values[i + 1]
            if rise * fall > 0.0:
                place = 0.5 * (rise - fall) / (rise + fall)
                value += 0.25 * (rise - fall) * place
                time += spacing * place
        if not value >= record[LOWEST]:
            record[LOWEST], record[LOWEST_TIME] = value, time
        if not value <= record[HIGHEST]:
            record[HIGHEST], record[HIGHEST_TIME] = value, time


@inner_kernel()
def look_between_shares(
    low: float,
    high: float,
    rows: np.ndarray,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
) -> None:
    """Seek extremes of watched channels from one share of a step to another."""
    place_evenly(low, high, at, spare)
    channels_within(work, spare, lane)
    waiting = 0
    for r in rows:
        if r < at.rows:
            waiting = look_at_instants(r, waiting, low, high, lane, run, at, work, spare, table)
    look_at_extremes(waiting, lane, run, at, work, spare, table, channels_around)


@deferred(
    void(
        *(ADDRESSES, PLACES, WORK, WORK, RUNS, float64[::1], float64[:, ::1], int64[:, ::1]),
        *(float64[:, ::1], int64[::1], float64[::1], float64[:, :, ::1]),
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
    ranges: np.ndarray,
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
    rows : (c,)
        Rows of the channel block.
    ranges : (c,)
        Range of each channel in its run, as far as it is known: what extremes are sharp against.
    records : (bins, c, 4)
        Lowest value, its time, highest value, its time; NaN where there is none yet.
    """
    call, at = functions_at(addresses[0]), places[0]
    work, spare, runs, table = unowned(work), unowned(spare), unowned(runs), unowned(table)
    values = np.empty(INSTANTS)
    p = 0
    for first in range(0, len(steps), LANES):
        count = min(LANES, len(steps) - first)
        for lane in range(LANES):
            read_step(steps[first + min(lane, count - 1)], lane, runs[lane], at, work)
        call.right_hand_side(work)
        for lane in range(LANES):
            remember_start(lane, at, work)
            for c in range(len(rows)):
                if rows[c] < at.rows:
                    work[at.known_range + rows[c], lane] = ranges[c]
        call.attempt(work)
        while p < len(parts) and parts[p, 0] < first + count:
            lane = parts[p, 0] - first
            run, record = runs[lane], records[parts[p, 1]]
            low, high = shares[p, 0], shares[p, 1]
            tried = work[at.tried, lane]
            begun = float(run.periods) * run.period + work[at.time, lane]
            place_evenly(low, high, at, spare)
            call.channels_within(work, spare, lane)
            for c in range(len(rows)):
                if rows[c] >= at.rows:
                    for i in range(INSTANTS):
                        values[i] = spare[at.channel + rows[c], i]
                    spacing = (high - low) * tried / (INSTANTS - 1)
                    count_smooth(record[c], values, begun + low * tried, spacing)
                elif math.isnan(record[c, LOWEST]):
                    record[c, LOWEST] = record[c, HIGHEST] = spare[at.channel + rows[c], 0]
                    record[c, LOWEST_TIME] = record[c, HIGHEST_TIME] = begun + low * tried
            load_records(rows, record, lane, at, work)
            waiting = 0
            for r in rows:
                if r < at.rows:
                    waiting = look_at_instants(
                        r, waiting, low, high, lane, run, at, work, spare, table
                    )
            look_at_extremes(waiting, lane, run, at, work, spare, table, call.channels_around)
            for j in range(at.pairs):
                if passes(j, lane, at, work):
                    share, width = closest_approach(j, lane, at, work)
                    from_there = max(share - WIDTHS * width, low)
                    to_there = min(share + WIDTHS * width, high)
                    if from_there < to_there - NARROWEST:
                        look_between_shares(
                            from_there,
                            to_there,
                            rows,
                            lane,
                            run,
                            at,
                            work,
                            spare,
                            table,
                            call.channels_around,
                            call.channels_within,
                        )
            store_records(rows, record, lane, at, work)
            p += 1
