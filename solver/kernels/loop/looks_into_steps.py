"""Closer looks into a part of a step, at the rows that may have records there.

Extremes are evaluated: a quartic may pass where a contact ends.
"""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.inner_peaks import EXACT, WIDTHS, place_evenly
from jointplay.solver.kernels.loop.passages import NARROWEST, closest_approach, passes
from jointplay.solver.kernels.loop.peaks import look_where_foretold
from jointplay.solver.kernels.loop.polynomial_extreme import has_corner
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.seeking_in_turn import seek_in_turn
from jointplay.solver.kernels.loop.tops import open_windows
from jointplay.solver.kernels.loop.windows import CLOSER


@inner_kernel()
def look_at_suspects(
    chosen: np.ndarray,
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
            r, 1, low, spacing, INSTANTS, EXACT, waiting, lane, run, at, work, table
        )
    if look_where_foretold(waiting, lane, run, at, work, spare, table, channels_around) > 0:
        seek_in_turn(waiting, lane, run, at, work, spare, table, channels_around)


@inner_kernel()
def find_cornered(
    chosen: np.ndarray, at: Places, spare: np.ndarray, book: np.ndarray, found: np.ndarray
) -> int:
    """Write those of chosen rows that no polynomial describes; how many is returned."""
    count = 0
    for r in chosen:
        if has_corner(r, at, spare, book):
            found[count] = r
            count += 1
    return count


@inner_kernel()
def look_beside_ends(
    cornered: np.ndarray,
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
    """Seek extremes between the ends of a part of a step and the instants beside them.

    Where a contact ends there, a force may dip and come back: it looks as if it went straight on.
    """
    spacing = (high - low) / (INSTANTS - 1)
    for begin in (low, high - spacing):
        place_evenly(begin, begin + spacing, at, spare)
        channels_within(work, spare, lane)
        look_at_suspects(
            cornered,
            begin,
            begin + spacing,
            lane,
            run,
            at,
            work,
            spare,
            table,
            channels_around,
        )


@inner_kernel()
def look_about_passages(
    every: np.ndarray,
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
