"""Steps whose ends do not tell what is between: where a method is at its limit of stability.

Friction that a steep ramp holds, and contacts that last, keep an explicit method's steps as short
as is stable. Every such step may swing alike inside, by as much as the ramp allows, while its ends
look smooth. Late stages of an explicit method tell (`solver.kernels.emit.judging.swings`): steps
that swing are looked at inside while a record may be in reach. Of other methods one step in so many
is, and all that follow a rough one.
"""

import numpy as np

from jointplay.solver.kernels.emit.closer_looks import EVERY
from jointplay.solver.kernels.emit.judging import SWINGING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.seeking import HALF
from jointplay.solver.kernels.loop.step import Step

ROUGH = 0.003
"""Share of a channel's range by which it leaves its values at the ends of a rough step."""
SEEN = 1e-6
"""The same, from which on a swing is worth a search."""
REACH = 4.0
"""Times that a swing may be larger between the instants, or in the next steps."""
GROWTH = 30.0
"""Times by which swings grow until steps are looked at again."""
ROUNDING = 1e-13
"""Share of the largest range of all channels that a range of nothing but rounding is below."""


@inner_kernel(borrows=True)
def is_due(s: Step) -> bool:
    """Whether a step is to be looked at inside, rough or not."""
    steps = int(s.work[s.at.steps, s.lane])
    return bool(steps < s.work[s.at.rough_until, s.lane] or steps % EVERY == EVERY - 1)


@inner_kernel()
def may_set_records(s: Step) -> bool:
    """Whether a channel that leaves its values at the ends of a step has a record in reach.

    Channels are known at eight even instants. Notes if the step is rough, and which of the next
    ones that swing is to be looked at: when ends that move as these do may be as far from a record
    as a swing goes, or when one swings more.
    """
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    widest, rough, near, most, pause = 0.0, False, False, 0.0, EVERY - 1.0
    for r in range(at.contact_row):  # behind are records of single contacts
        widest = max(widest, work[at.highest + r, lane] - work[at.lowest + r, lane])
    for r in range(at.contact_row):
        lowest, highest = work[at.lowest + r, lane], work[at.highest + r, lane]
        spread = highest - lowest
        if spread <= ROUNDING * widest:
            continue
        first, last = spare[at.channel + r, 0], spare[at.channel + r, INSTANTS - 1]
        low, high = min(first, last), max(first, last)
        least, most_here = low, high
        for i in range(1, INSTANTS - 1):
            least = min(least, spare[at.channel + r, i])
            most_here = max(most_here, spare[at.channel + r, i])
        above, below = most_here - high, low - least
        swing = max(above, below)
        rough |= swing > ROUGH * spread
        near |= above > SEEN * spread and high + REACH * above > highest
        near |= below > SEEN * spread and low - REACH * below < lowest
        most = max(most, swing / spread)
        if swing > SEEN * spread:
            middle = spare[at.channel + r, HALF - 1] + spare[at.channel + r, HALF]
            bend = 4.0 * (first + last - middle)
            rest = min(highest - high, low - lowest)
            pause = min(pause, steps_until(rest, last - first, bend, REACH * swing))
    steps = int(work[at.steps, lane])
    if rough:
        s.run.rough += 1
    if rough and near and not int(work[at.flag, lane]) & SWINGING:
        work[at.rough_until, lane] = steps + EVERY
    work[at.look_at, lane] = steps + 1.0 + np.floor(pause)
    work[at.look_beyond, lane] = work[at.swing, lane] * max(GROWTH, SEEN / (most + 1e-300))
    return near


@inner_kernel()
def steps_until(rest: float, change: float, bend: float, swing: float) -> float:
    """Return in how many steps a swing may come to a record that now is farther by `rest`.

    Ends of steps must come as close to it, and turn: while they change by more than that from one
    step to the next, the next one is beyond all that is in this. They are taken to change and bend
    twice as much as in this step.
    """
    speed, bend = abs(change), abs(bend) + 1e-300
    close = max(rest - swing, 0.0)
    return 0.5 * max(close / (speed + np.sqrt(bend * close) + 1e-300), (speed - swing) / bend)
