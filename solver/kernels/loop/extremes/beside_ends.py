"""Extremes beside the ends of a part of a step, of rows that no polynomial describes."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.even_instants import place_evenly, seek_between
from jointplay.solver.kernels.loop.extremes.polynomial_extreme import has_corner
from jointplay.solver.kernels.loop.step import Step, channels_within


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
        seek_between(cornered, begin, begin + spacing, s)
