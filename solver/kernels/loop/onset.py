"""Finds where inside a step a gap closes, or opens, on the dense output."""

import math

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.step import Step, penetrations_within

NO_ONSET = math.inf
NEWTON_STEPS = 2
TURNING_LEVELS = 4
"""Each narrows the interval of a turning point to an eighth."""


@inner_kernel()
def look_between(low: float, high: float, s: Step) -> None:
    """Evaluate all gaps at eight equal distances from one share of the step to another."""
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = low + (high - low) * (i + 1) / INSTANTS
    penetrations_within(s)


@inner_kernel()
def forget_looks(s: Step) -> None:
    """Say that what `spare` has is of another step."""
    s.spare[s.at.theta, 0] = math.nan


@inner_kernel()
def look_at_eighths(s: Step) -> None:
    """Evaluate all gaps at the ends of eighths of the step, unless that was the last look at it."""
    first, last = s.spare[s.at.theta, 0], s.spare[s.at.theta, INSTANTS - 1]
    if not (first == 1.0 / INSTANTS and last == 1.0):
        look_between(0.0, 1.0, s)


@inner_kernel()
def first_onset(j: int, s: Step) -> float:
    """Return the share of the step after which pair j's gap first closes, `NO_ONSET` if never.

    The gap is looked at at eight instants; where its rate turns between two of them without the gap
    closing, though it might have, the turning point is sought (a grazing contact).
    """
    begun = 0
    while begun < INSTANTS:
        look_at_eighths(s)
        i = next_suspect(1.0, j, begun, s)
        if i == INSTANTS:
            break
        left, right = i / INSTANTS, (i + 1) / INSTANTS
        closed = right
        if s.spare[s.at.penetration + j, i] <= 0.0:
            closed = crossed_between(1.0, j, left, right, s)
        if closed < NO_ONSET:
            return polish(j, left, closed, s)
        begun = i + 1
    return NO_ONSET


@inner_kernel()
def next_suspect(sense: float, j: int, begun: int, s: Step) -> int:
    """Return the first eighth of the step, from the one with number `begun` on, that may touch.

    The gap is closed at its end, or rises at its beginning and falls at its end from where it would
    close if it went on for the eighth at twice these rates. None: the number of eighths. With the
    `sense` -1 instead of 1, all is the other way round: the first in which it may open.
    """
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    for i in range(begun, INSTANTS):
        penetration = sense * spare[at.penetration + j, i]
        rate = sense * spare[at.penetration_rate + j, i]
        before = sense * work[at.penetration_start + j, lane]
        before_rate = sense * work[at.penetration_rate_start + j, lane]
        if i > 0:
            before = sense * spare[at.penetration + j, i - 1]
            before_rate = sense * spare[at.penetration_rate + j, i - 1]
        if penetration > 0.0:
            return i
        reach = 2.0 * work[at.tried, lane] / INSTANTS
        if (
            before_rate > 0.0 > rate
            and min(before + reach * before_rate, penetration - reach * rate) > 0.0
        ):
            return i
    return INSTANTS


@inner_kernel()
def crossed_between(sense: float, j: int, left: float, right: float, s: Step) -> float:
    """Return a share of the step at which pair j's gap is closed, `NO_ONSET` if there is none.

    From one share to another, between which the gap's rate turns from rising to falling. With the
    `sense` -1 instead of 1, at which it is open, and the other way round.
    """
    spare = s.spare
    for _ in range(TURNING_LEVELS):
        look_between(left, right, s)
        turning = INSTANTS - 1
        for i in range(INSTANTS):
            if sense * spare[s.at.penetration + j, i] > 0.0:
                return float(spare[s.at.theta, i])
            if sense * spare[s.at.penetration_rate + j, i] < 0.0 and turning == INSTANTS - 1:
                turning = i
        width = (right - left) / INSTANTS
        left = left + width * turning
        right = left + width
    return NO_ONSET


@inner_kernel()
def newton_step(share: float, penetration: float, rate: float, tried: float) -> float:
    """Return the share of a step at which a gap is closed, by Newton's rule from another one."""
    return share - penetration / (rate * tried) if rate > 0.0 else share


@inner_kernel()
def polish(j: int, left: float, right: float, s: Step) -> float:
    """Return the root of pair j's gap in a bracket: sectioning, then Newton inside the bracket."""
    lane, at, work, spare = s.lane, s.at, s.work, s.spare
    tried = work[at.tried, lane]
    root = right
    look_between(left, right, s)
    for i in range(INSTANTS):
        if spare[at.penetration + j, i] > 0.0:
            right = spare[at.theta, i]
            left = right - (right - left) / INSTANTS if i == 0 else spare[at.theta, i - 1]
            penetration, rate = spare[at.penetration + j, i], spare[at.penetration_rate + j, i]
            root = min(max(newton_step(right, penetration, rate, tried), left), right)
            break
    for _ in range(NEWTON_STEPS):
        spare[at.theta, 0] = root
        penetrations_within(s)
        penetration, rate = spare[at.penetration + j, 0], spare[at.penetration_rate + j, 0]
        better = newton_step(root, penetration, rate, tried)
        if left <= better <= right:
            root = better
    return root
