"""Extremes inside steps that no scan of step ends finds: where journals pass, where runs end."""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extreme import (
    POINTS,
    SHARES,
    TIMES,
    VALUES,
    compare_times,
    compare_values,
)
from jointplay.solver.kernels.loop.passages import (
    NARROWEST,
    closest_approach,
    distance_and_speed,
    orbiting_at_end,
    passes,
    place_about,
)
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.seeking import seek, time_at

BETWEEN = 0.02
"""Share of the spread of a channel's values by which it may exceed them between instants."""
SLACK = 0.1
"""Share of a journal's speed by which the slip at a passage may exceed what is expected."""


@kernel()
def look_at_passages(
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_within: LaneFunction,
    channels_around: LaneFunction,
) -> None:
    """Seek extremes where a journal passes the centre of its bearing: its normal whips round there.

    To be called while ``channel`` has the values at the step's end, before the scan.
    """
    for j in range(at.joints):
        if not passes(j, lane, at, work):
            continue
        share, width = closest_approach(j, lane, at, work)
        if NARROWEST < share < 1.0 - NARROWEST and may_be_fastest(j, share, width, lane, at, work):
            for row in (work[at.slip_row + j, lane], work[at.penetration_row + j, lane]):
                look_inside(
                    share,
                    width,
                    int(row),
                    int(row) + 1,
                    lane,
                    run,
                    at,
                    work,
                    spare,
                    table,
                    channels_within,
                    channels_around,
                )


@kernel()
def may_be_fastest(
    j: int, share: float, width: float, lane: int, at: Places, work: np.ndarray
) -> bool:
    """Whether slip or penetration of a joint may have a record where its journal passes the centre.

    There the slip is that of the spins, as at the end of the step, and all of the journal's speed.
    """
    distance, speed = distance_and_speed(j, share, lane, at, work)
    slip, depth = int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])
    spinning = work[at.channel + slip, lane] - orbiting_at_end(j, lane, at, work)
    beyond = SLACK * speed
    return bool(
        spinning + speed + beyond > work[at.highest + slip, lane]
        or spinning - speed - beyond < work[at.lowest + slip, lane]
        or distance - work[at.inner + j, lane] < work[at.lowest + depth, lane]
    )


@kernel()
def look_at_last_step(
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_within: LaneFunction,
    channels_around: LaneFunction,
) -> None:
    """Seek extremes in a step that ends the run: no later one would tell that a channel turned."""
    if work[at.arrival, lane] >= work[at.end, lane]:
        look_inside(
            0.0,
            0.0,
            0,
            at.rows,
            lane,
            run,
            at,
            work,
            spare,
            table,
            channels_within,
            channels_around,
        )


@kernel()
def look_inside(
    share: float,
    width: float,
    first: int,
    behind: int,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_within: LaneFunction,
    channels_around: LaneFunction,
) -> None:
    """Seek extremes of the rows `first` to `behind` inside this step, where `place_about` says."""
    place_about(share, width, at, spare)
    channels_within(work, spare, lane)
    for r in range(first, behind):
        for sense in (1.0, -1.0):
            if not may_be_record(r, sense, lane, at, work, spare):
                continue
            for i in range(INSTANTS):
                table[SHARES + i] = 1.0 + spare[at.theta, i]
                table[VALUES + i] = spare[at.channel + r, i]
            table[SHARES + INSTANTS] = 2.0
            table[VALUES + INSTANTS] = work[at.channel + r, lane]
            for i in range(POINTS):
                table[TIMES + i] = time_at(table[SHARES + i], lane, at, work)
            compare_times(table)
            compare_values(table)
            if seek(r, sense, lane, run, at, work, spare, table, channels_around):
                place_about(share, width, at, spare)
                channels_within(work, spare, lane)


@kernel()
def may_be_record(
    r: int, sense: float, lane: int, at: Places, work: np.ndarray, spare: np.ndarray
) -> bool:
    """Whether a channel may have a record at or between the instants that were looked at."""
    low = high = spare[at.channel + r, 0]
    for i in range(1, INSTANTS):
        low = min(low, spare[at.channel + r, i])
        high = max(high, spare[at.channel + r, i])
    between = BETWEEN * (high - low)
    if sense > 0.0:
        return bool(high + between > work[at.highest + r, lane] and high > low)
    return bool(low - between < work[at.lowest + r, lane] and high > low)
