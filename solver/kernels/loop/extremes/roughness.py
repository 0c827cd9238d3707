"""Steps whose ends do not tell what is between: where a method is at its limit of stability.

Friction that a steep ramp holds, and contacts that last, keep an explicit method's steps as short
as is stable. Every such step may swing alike inside, by as much as the ramp allows, while its ends
look smooth. Late stages of an explicit method tell (`solver.kernels.emit.judging.swings`): steps
that swing are looked at inside while an extreme so far may be in reach. Of other methods one step
in so many is, and all that follow a rough one, or one whose ends show nothing of a swing.
"""

import numpy as np

from jointplay.solver.kernels.emit.closer_looks import EVERY
from jointplay.solver.kernels.emit.judging import SWINGING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.search.brackets import TINY
from jointplay.solver.kernels.loop.extremes.swinging import (
    NEARBY,
    SEEN,
    UNEVEN,
    UNSEEN_AT_ENDS,
    weigh_swings,
)
from jointplay.solver.kernels.loop.step import Step


@inner_kernel(borrows=True)
def is_due(s: Step) -> bool:
    """Whether a step is to be looked at inside, rough or not."""
    steps = int(s.work[s.at.steps, s.lane])
    return bool(steps < s.work[s.at.rough_until, s.lane] or steps % EVERY == EVERY - 1)


@inner_kernel()
def may_set_extremes(s: Step) -> bool:
    """Whether a channel that leaves its values at the ends of a step has an extreme in reach.

    Channels are known at eight even instants. Notes if the step is rough, and which of the next
    ones that swing is to be looked at: when ends that move as these do may be as far from an
    extreme as a swing goes, or when one swings more, or is longer and swings.
    """
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    # behind are those of single contacts
    slots = (at.highest, at.lowest, at.rounding, at.change, at.contact_row)
    longer = work[at.tried, lane] / work[at.before_step, lane]
    answer, pause, most = weigh_swings(spare, at.channel, work, slots, lane, longer, EVERY - 1.0)
    steps = int(work[at.steps, lane])
    near, rough, unseen = answer & NEARBY != 0, answer & UNEVEN != 0, answer & UNSEEN_AT_ENDS != 0
    if rough:
        s.run.rough += 1
    if (rough or unseen) and near and not int(work[at.flag, lane]) & SWINGING:
        work[at.rough_until, lane] = steps + EVERY
    work[at.looked_into, lane] = work[at.tried, lane]
    if int(work[at.flag, lane]) & SWINGING and work[at.swing, lane] <= 0.0:
        return near  # looked into for its length: that tells nothing of steps that swing
    work[at.look_at, lane] = steps + 1.0 + np.floor(pause)
    if most > 0.0 or work[at.look_beyond, lane] == 0.0:
        work[at.look_beyond, lane] = work[at.swing, lane] * (SEEN / (most + TINY))
    # else channels rise by more than they swing, and the last limit holds
    return near
