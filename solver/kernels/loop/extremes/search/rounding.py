"""Rounding of channels: they scatter from one instant to the next, hardly later.

A force that nothing carries is a difference of large numbers: it turns at every instant, and looks
inside a step find another extreme wherever they look.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.step import Step

SHORT = 2.0**-30
"""Share of a step in which a channel that is more than rounding hardly moves."""
SCATTER = 8.0
"""Times the median change of slope in such a time that rounding amounts to in a step."""
LARGE = 0.25
"""Share of what values differ by from which on a change is one that counts."""
ENOUGH = 2
"""Turns between such changes that rounding makes."""
ROUNDING = 1e-12
"""Share of the largest range of channels of its kind that one of nothing but rounding is below."""
GROWN = 2.0
"""Times that a range has grown by when rounding is noted anew."""


@inner_kernel()
def scatter(values: np.ndarray) -> float:
    """Return what a channel is rounded by, from its values at instants with hardly a distance.

    From the median of how much its slope changes: a jump among them is no rounding.
    """
    bends = np.empty(INSTANTS - 2)
    for i in range(len(bends)):
        bend, k = abs(values[i] - 2.0 * values[i + 1] + values[i + 2]), i
        while k > 0 and bends[k - 1] > bend:
            bends[k] = bends[k - 1]
            k -= 1
        bends[k] = bend
    return SCATTER * bends[(len(bends) - 1) // 2]


@inner_kernel()
def place_closely(share: float, theta: np.ndarray) -> None:
    """Place eight instants with hardly a distance from a share of a step on."""
    for i in range(INSTANTS):
        theta[i] = share + SHORT * i


@inner_kernel()
def spread_of(values: np.ndarray, count: int) -> float:
    """Return by how much the first values differ."""
    least = most = values[0]
    for i in range(1, count):
        least, most = min(least, values[i]), max(most, values[i])
    return float(most - least)


@inner_kernel()
def zigzags(values: np.ndarray, count: int) -> bool:
    """Whether the first values turn twice, each time by more than a part of what they differ by.

    A corner or a narrow peak turns once, and a jump does not turn.
    """
    least, turns, before = LARGE * spread_of(values, count), 0, 0.0
    for i in range(1, count):
        change = values[i] - values[i - 1]
        if abs(change) > least:
            turns += int(change * before < 0.0)
            before = change
    return turns >= ENOUGH


@inner_kernel(borrows=True)
def note_range(r: int, s: Step) -> None:
    """Have a channel's range up to now tell what is rounding, when it has grown by much."""
    lane, at, work = s.lane, s.at, s.work
    full = work[at.highest + r, lane] - work[at.lowest + r, lane]
    if ROUNDING * full > GROWN * work[at.rounding + r, lane]:
        note_rounding(s)


@inner_kernel()
def note_rounding(s: Step) -> None:
    """Note below which range up to now each channel is nothing but rounding.

    Channels of a kind (`solver.kernels.trace.rows`) are compared with each other.
    """
    lane, at, work = s.lane, s.at, s.work
    for r in range(at.contact_row):  # behind are those of single contacts
        first = int(work[at.alike + r, lane])
        least = ROUNDING * (work[at.highest + r, lane] - work[at.lowest + r, lane])
        if r > first:
            least = max(least, work[at.rounding + first, lane])
        work[at.rounding + first, lane] = least
    for r in range(at.contact_row):
        work[at.rounding + r, lane] = work[at.rounding + int(work[at.alike + r, lane]), lane]
