"""Steps whose ends do not tell what is between: where a method is at its limit of stability.

Friction that a steep ramp holds, and contacts that last, keep an explicit method's steps as short
as is stable. Every such step may swing alike inside, by as much as the ramp allows, while its ends
look smooth. Late stages of an explicit method tell (`solver.kernels.emit.judging.swings`): steps
that swing are looked at inside, the less often the longer no record was near. Of other methods one
step in so many is, and all that follow a rough one.
"""

import numpy as np

from jointplay.solver.kernels.emit.judging import SWINGING
from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.runs import Run

EVERY = 256
"""Steps from one look inside to the next, and those that are looked at after a rough one."""
ROUGH = 0.003
"""Share of a channel's range by which it leaves its values at the ends of a rough step."""
SEEN = 1e-6
"""The same, from which on a swing is worth a search."""
REACH = 4.0
"""Times that a swing may be larger between the instants, or in the next steps."""
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
def may_set_records(lane: int, run: Run, at: Places, work: np.ndarray, spare: np.ndarray) -> bool:
    """Whether a channel that leaves its values at the ends of a step has a record in reach.

    Channels are known at eight even instants. Notes if the step is rough, and after how many steps
    one that swings is to be looked at: the next one, or the longer the longer no record is near.
    """
    widest, rough, near, ahead = 0.0, False, False, False
    for r in range(at.contact_row):  # behind are records of single contacts
        widest = max(widest, work[at.highest + r, lane] - work[at.lowest + r, lane])
    for r in range(at.contact_row):
        lowest, highest = work[at.lowest + r, lane], work[at.highest + r, lane]
        spread = highest - lowest
        if spread <= ROUNDING * widest:
            continue
        first, last = spare[at.channel + r, 0], spare[at.channel + r, INSTANTS - 1]
        low, high = min(first, last), max(first, last)
        least, most = low, high
        for i in range(1, INSTANTS - 1):
            least, most = min(least, spare[at.channel + r, i]), max(most, spare[at.channel + r, i])
        above, below = most - high, low - least
        rough |= max(above, below) > ROUGH * spread
        near |= above > SEEN * spread and high + REACH * above > highest
        near |= below > SEEN * spread and low - REACH * below < lowest
        # steps swing in turn: one that dips is followed by one that tops
        ahead |= below > SEEN * spread and high + REACH * below > highest
        ahead |= above > SEEN * spread and low - REACH * above < lowest
    steps = int(work[at.steps, lane])
    if rough:
        run.rough += 1
    if rough and near and not int(work[at.flag, lane]) & SWINGING:
        run.rough_until = steps + EVERY
    begins = steps > int(work[at.look_at, lane]) + EVERY
    run.far = 0 if near or ahead or begins else min(run.far + run.far // 2 + 1, EVERY - 1)
    work[at.look_at, lane] = float(steps + 1 + run.far)
    return near
