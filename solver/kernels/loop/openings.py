"""Where inside a step a gap opens, and how the step is made to end there."""

import numpy as np

from jointplay.solver.kernels.emit.judging import LANDED
from jointplay.solver.kernels.jit import inner_kernel, kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.onset import (
    NO_ONSET,
    crossed_between,
    look_at_eighths,
    next_suspect,
)
from jointplay.solver.kernels.loop.runs import NO_PAIR
from jointplay.solver.kernels.loop.step import Step

MOST_ITERATIONS = 40
ROOT = 1e-15
"""Change of a root, as a share of the step, that ends the search for it."""
BEHIND = 1.02
"""A step that opens a gap ends at this multiple of the time to there: open, for certain."""
LATE = 0.95
"""A step in which a gap opens after this share of it is taken as it is."""


@kernel()
def dip(j: int, s: Step) -> float:
    """Return a share of the step at which pair j's gap is open, though it closes again.

    The gap is looked at at eight instants, and for where it turns between two of them. 1: it stays
    closed, or once open it stays so. Where contact has only just begun, it must have been deeper.
    """
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    look_at_eighths(s)
    begun = 0
    if work[at.penetration_start + j, lane] <= LANDED:
        while begun < INSTANTS and spare[at.penetration + j, begun] <= LANDED:
            begun += 1
        begun += 1
    while begun < INSTANTS:
        i = next_suspect(-1.0, j, begun, s)
        if i == INSTANTS:
            break
        left, right = i / INSTANTS, (i + 1) / INSTANTS
        if spare[at.penetration + j, i] < 0.0:
            for later in range(i + 1, INSTANTS):
                if spare[at.penetration + j, later] > 0.0:
                    return right
            break
        open_at = crossed_between(-1.0, j, left, right, s)
        if open_at < NO_ONSET:
            return open_at
        begun = i + 1
        look_at_eighths(s)
    return 1.0


@kernel()
def falling_root(start: float, start_rate: float, end: float, end_rate: float) -> float:
    """Return where in 0..1 the cubic through both ends falls to zero: Newton inside a bracket.

    Rates are changes over the whole interval; start > 0 >= end.
    """
    square = 3.0 * (end - start) - 2.0 * start_rate - end_rate
    cube = 2.0 * (start - end) + start_rate + end_rate
    low, high = 0.0, 1.0
    x = start / (start - end)
    for _ in range(MOST_ITERATIONS):
        value = start + x * (start_rate + x * (square + x * cube))
        slope = start_rate + x * (2.0 * square + 3.0 * x * cube)
        if value > 0.0:
            low = x
        else:
            high = x
        better = x - value / slope if slope < 0.0 else low
        if not low < better < high:
            better = 0.5 * (low + high)
        if abs(better - x) <= ROOT:
            break
        x = better
    return x


@inner_kernel()
def note_openings(s: Step, inside: bool) -> float:
    """Note when in this step each contact ends: at the root of the cubic through both its ends.

    Infinite where its gap is closed at the end. Where contact has only just begun, it must be on
    its way apart. Return the smallest of these shares of the step, 1 where no contact worth
    mentioning ends. A gap that was open `inside` the step, which is to be taken otherwise, and
    closed again has ended a contact: what touches then is another one, with an impact rate of its
    own. The share is then such that the step redone ends within that opening, or at least before
    its end. Of a contact that begins where the step does and has ended within it the share is about
    the middle, for it may lie between two stages, and its force be seen by none.
    """
    lane, at, work = s.lane, s.at, s.work
    step = work[at.tried, lane]
    soonest = 1.0
    for j in range(at.pairs):
        if work[at.mode + j, lane] <= 0.0:
            continue
        penetration = work[at.penetration + j, lane]
        rate = work[at.penetration_rate + j, lane] * step
        start = work[at.penetration_start + j, lane]
        start_rate = work[at.penetration_rate_start + j, lane] * step
        fixed = work[at.restart + j, lane] == np.inf
        high = 1.0
        if start > 0.0 >= penetration:
            high = falling_root(start, start_rate, penetration, rate)
        if start > LANDED and not fixed:
            soonest = min(soonest, high)
        if inside and not fixed:
            low = dip(j, s)
            if low < 1.0:
                soonest = min(soonest, min(low, LATE) / BEHIND)
            if start <= LANDED and penetration <= 0.0 and rate < 0.0 < start_rate:
                whole = start_rate / (start_rate - penetration)
                if 0.25 * start_rate * whole > LANDED:
                    soonest = min(soonest, 0.5 * whole)
        open_now = penetration <= 0.0 and (start > LANDED or rate < 0.0)
        work[at.opened + j, lane] = work[at.time, lane] + high * step if open_now else np.inf
    return soonest


@inner_kernel()
def end_behind_opening(share: float, s: Step) -> None:
    """Have this step redone so that it ends where a gap opens, after `share` of it.

    The force of a contact has no second derivative there. Within a step its error would depend on
    where between the stages it falls, and the steps that are accepted are those whose estimate
    happens to be too small. The estimate of a step with the kink inside says nothing of the steps
    to either side: what a rejection asks for does not count.
    """
    lane, at, work = s.lane, s.at, s.work
    work[at.accept, lane] = 0.0
    work[at.next_step, lane] = BEHIND * share * work[at.tried, lane]
    s.run.landing = NO_PAIR
    s.run.landings = 0
