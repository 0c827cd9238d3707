"""Closer looks into a part of a step, at the rows that may have new extremes there.

Extremes are evaluated: a quartic may pass where a contact ends.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.brackets import CLOSER
from jointplay.solver.kernels.loop.inner_peaks import EXACT, WIDTHS, place_evenly
from jointplay.solver.kernels.loop.passages import NARROWEST, closest_approach, passes
from jointplay.solver.kernels.loop.peaks import look_where_foretold
from jointplay.solver.kernels.loop.polynomial_extreme import has_corner
from jointplay.solver.kernels.loop.seeking_in_turn import seek_in_turn
from jointplay.solver.kernels.loop.step import Step, channels_within
from jointplay.solver.kernels.loop.tops import open_brackets


@inner_kernel()
def look_at_suspects(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows that are known at even instants between two shares."""
    waiting, spacing = 0, (high - low) / (INSTANTS - 1)
    for r in chosen:
        for i in range(INSTANTS):  # a slice would take 2 s to compile, for what it raises
            s.table[CLOSER + i] = s.spare[s.at.channel + r, i]
        waiting = open_brackets(r, 1, low, spacing, INSTANTS, EXACT, waiting, s)
    if look_where_foretold(waiting, s) > 0:
        seek_in_turn(waiting, s)


@inner_kernel()
def find_cornered(chosen: np.ndarray, s: Step, book: np.ndarray, found: np.ndarray) -> int:
    """Write those of chosen rows that no polynomial describes. Returns how many."""
    count = 0
    for r in chosen:
        if has_corner(r, s, book):
            found[count] = r
            count += 1
    return count


@inner_kernel()
def look_beside_ends(cornered: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes between the ends of a part of a step and the instants beside them.

    Where a contact ends there, a force may dip and come back: it looks as if it went straight on.
    """
    spacing = (high - low) / (INSTANTS - 1)
    for begin in (low, high - spacing):
        place_evenly(begin, begin + spacing, s)
        channels_within(s)
        look_at_suspects(cornered, begin, begin + spacing, s)


@inner_kernel()
def look_about_passages(every: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes where journals pass the centres of their bearings, between two shares."""
    for j in range(s.at.pairs):
        if passes(j, s):
            share, width = closest_approach(j, s)
            left, right = max(share - WIDTHS * width, low), min(share + WIDTHS * width, high)
            if left < right - NARROWEST:
                place_evenly(left, right, s)
                channels_within(s)
                look_at_suspects(every, left, right, s)
