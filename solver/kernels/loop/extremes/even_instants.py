"""Eight even instants of a part of a step, and the extremes of rows between them."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.local_extremes import open_brackets
from jointplay.solver.kernels.loop.extremes.seeking import seek
from jointplay.solver.kernels.loop.step import Step, channels_within

EXACT = 0.0
"""Share of its range by which what is counted may be off: a quartic through such instants may pass
where a contact ends.  Extremes are evaluated where it turns."""


@inner_kernel()
def place_evenly(low: float, high: float, s: Step) -> None:
    """Place eight instants evenly from one share of a step to another."""
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = low + (high - low) * (i / (INSTANTS - 1))


@inner_kernel()
def look_evenly(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows between two shares of a step."""
    place_evenly(low, high, s)
    channels_within(s)
    seek_between(chosen, low, high, s)


@inner_kernel()
def seek_between(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows that are known at even instants between two shares."""
    waiting, spacing = 0, (high - low) / (INSTANTS - 1)
    for r in chosen:
        values = s.brackets[waiting].seen
        for i in range(INSTANTS):  # a slice would take 2 s to compile, for what it raises
            values[i] = s.spare[s.at.channel + r, i]
        waiting = open_brackets(r, 1, low, spacing, INSTANTS, EXACT, waiting, s)
    seek(waiting, s)
