"""Steps whose ends do not tell what is between: where a method is at its limit of stability.

Friction that a steep ramp holds, and contacts that last, keep an explicit method's steps as short
as is stable. Every such step may swing alike inside, by as much as the ramp allows, while its ends
look smooth. One step in so many is therefore looked at inside, and all that follow a rough one.
What a run's rough steps hid before the first of them was found is not among its extremes.
"""

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.runs import Run

EVERY = 256
"""Steps from one look inside to the next, and those that are looked at after a rough one."""
ROUGH = 0.003
"""Share of a channel's range by which it leaves its values at the ends of a rough step."""
ROUNDING = 1e-13
"""Share of the largest range of all channels that a range of nothing but rounding is below."""


@inner_kernel()
def is_due(lane: int, run: Run, at: Places, work: np.ndarray) -> bool:
    """Whether a step is to be looked at inside, rough or not."""
    steps = int(work[at.steps, lane])
    return bool(steps < run.rough_until or steps % EVERY == EVERY - 1)


@inner_kernel()
def any_due(runs: np.ndarray, at: Places, work: np.ndarray) -> bool:
    """Whether a step of any lane is to be looked at inside."""
    found = False
    for lane in range(LANES):
        found |= is_due(lane, runs[lane], at, work)
    return found


@inner_kernel()
def is_rough(lane: int, run: Run, at: Places, work: np.ndarray, spare: np.ndarray) -> bool:
    """Whether a step is rough, whose channels are known at eight even instants; notes if it is."""
    widest = 0.0
    for r in range(at.contact_row):  # behind are records of single contacts
        widest = max(widest, work[at.highest + r, lane] - work[at.lowest + r, lane])
    for r in range(at.contact_row):
        spread = work[at.highest + r, lane] - work[at.lowest + r, lane]
        if spread <= ROUNDING * widest:
            continue
        first, last = spare[at.channel + r, 0], spare[at.channel + r, INSTANTS - 1]
        low, high = min(first, last) - ROUGH * spread, max(first, last) + ROUGH * spread
        for i in range(1, INSTANTS - 1):
            if not low <= spare[at.channel + r, i] <= high:
                run.rough += 1
                run.rough_until = int(work[at.steps, lane]) + EVERY
                return True
    return False
