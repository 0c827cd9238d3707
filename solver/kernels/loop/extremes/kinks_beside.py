"""Extremes at a kink next to where a step begins: just before it, or just behind.

Where friction bends or a contact ends a hundredth of a step away, a channel that goes on beyond the
step's start and turns at the kink looks, at quarters of both steps, as if it had its corner there.
Where such kinks are is known: a contact ended when its gap opened, and slip has a value and a rate.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import BENDS
from jointplay.solver.kernels.loop.extremes.bends import has_bend
from jointplay.solver.kernels.loop.extremes.search.brackets import NODES, SHARP
from jointplay.solver.kernels.loop.extremes.search.local_extremes import open_brackets
from jointplay.solver.kernels.loop.extremes.search.narrowing import PER_STEP
from jointplay.solver.kernels.loop.extremes.search.seeking import FORETOLD
from jointplay.solver.kernels.loop.step import Step, channels_around

FARTHEST = 0.25
"""Share of a step from its end beyond which quarters of the step tell of a kink."""
REACH = 2.0
"""Times that a channel may change faster up to a kink than on the other side of the start."""


@inner_kernel(borrows=True)
def nearest_kink(step: int, s: Step) -> float:
    """Return how far from the start of this step the nearest kink is: 0 if none is near.

    In shares of this step, for one behind (`step` 1), or of the step before (0).
    """
    lane, at, work = s.lane, s.at, s.work
    now, before = work[at.time, lane], work[at.before_step, lane]
    length = work[at.tried, lane] if step else -before
    nearest = FARTHEST
    for j in range(at.pairs):
        ended = (now - work[at.opened + j, lane]) / before
        if step == 0 and 0.0 < ended < nearest:
            nearest = ended
        if not has_bend(j, s):
            continue
        slip, slips = work[at.slip_start + j, lane], length * work[at.slip_rate_start + j, lane]
        for k in range(BENDS * j, BENDS * (j + 1)):
            for bend in (work[at.bend + k, lane], -work[at.bend + k, lane]):
                ahead = bend - slip
                if ahead * slips > 0.0 and abs(ahead) < nearest * abs(slips):
                    nearest = ahead / slips
    return nearest if nearest < FARTHEST else 0.0


@inner_kernel(borrows=True)
def any_in_reach(rows: np.ndarray, before: float, behind: float, s: Step) -> bool:
    """Whether a row that turns about this step's start may have a new extreme at a kink beside it.

    Up to a kink it goes on as on the other side of the start. `before`, `behind` : how far kinks
    are away.
    """
    lane, at, work = s.lane, s.at, s.work
    for r in rows:
        start = work[at.previous + r, lane] - work[at.change + r, lane]
        rose = start - s.spare[at.channel + r, PER_STEP - 1]
        fell = start - s.spare[at.channel + r, PER_STEP + 1]
        far = REACH * PER_STEP * max(before * abs(fell), behind * abs(rose))
        highest, lowest = work[at.highest + r, lane], work[at.lowest + r, lane]
        turns = start + far > highest if rose > 0.0 else start - far < lowest
        if rose * fell > 0.0 and turns and far > SHARP * (highest - lowest):
            return True
    return False


@inner_kernel(borrows=True)
def look_at_kinks_beside(rows: np.ndarray, waiting: int, s: Step) -> int:
    """Let extremes of rows at kinks next to the start of this step count, if they are sharp.

    Returns how many brackets wait to be looked at more closely, of all channels. To be called while
    `spare` has the channels at quarters of both steps.
    """
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    before, behind = nearest_kink(0, s), nearest_kink(1, s)
    near = before > 0.0 or behind > 0.0
    if not (near and any_in_reach(rows, before, behind, s)):
        return waiting
    for i in range(PER_STEP):
        spare[at.theta, i] = 1.0 - 0.5 * (PER_STEP - i) * before
        spare[at.theta, PER_STEP + i] = 0.5 * (i + 1) * behind
    channels_around(s)
    for r in rows:
        for step, beside in enumerate((before, behind)):
            if beside == 0.0:
                continue
            values = s.brackets[waiting].seen
            for i in range(PER_STEP):
                values[step + i] = spare[at.channel + r, PER_STEP * step + i]
            values[(1 - step) * PER_STEP] = work[at.previous + r, lane] - work[at.change + r, lane]
            start, spacing = (1 - step) * (1.0 - 0.5 * PER_STEP * beside), 0.5 * beside
            waiting = open_brackets(r, step, start, spacing, NODES, FORETOLD, waiting, s)
    return waiting
