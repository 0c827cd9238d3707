"""Consequences of a step: how much the next one grows, and what contacts did in it."""

from collections.abc import Callable

from jointplay.solver.integrators import Method
from jointplay.solver.kernels.emit.enclosure import beyond, may_open, whips_round
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.elementary import coarse_exp2, log2
from jointplay.solver.quantities.scalars import Scalar, maximum, minimum, select_positive

SAFETY = 0.95
PROPORTIONAL = 0.04
"""Weight of the previous error in the step controller (Hairer and Wanner 1996, IV.2)."""
LARGEST_GROWTH, LARGEST_CUT = 5.0, 0.2

LANDED = 1e-13
"""Largest penetration, m, at which an onset counts as located. No share of anything: above the
rounding of places up to 100 m away, and no more than 1e-4 of clearances down to 1 nm."""

SWING = 0.003
"""Share of a slope by which it swings noticeably inside a step."""
JUMP = 2.0
"""Times the changes of a slope from stage to stage by which its mean may leave that of the ends of
a step without a jump. A parabola does so by 1.23 of them at most."""
NOTICED = 0.01
"""The least of that in tolerances of the speed: less may be rounding."""

REJECTED, DUE, ONSET, RELEASE, PACE, PASSING, SWINGING = 1, 2, 4, 8, 16, 32, 64
"""Bit mask of what a lane's attempt asks the loop to look after; lanes hold it as a float. The last
two, the largest, tell that a step may have extremes inside which its ends do not show."""


def growth(order: float, good: Expression, magnitude: Expression, memory: Expression) -> Expression:
    """Return the factor from a step to the next.

    `order` : of the error in the step; `good` : positive where it is accepted; `magnitude` and
    `memory` : log2 of this step's error and of the last one's, in tolerances.
    """
    exponent = 1.0 / order
    smooth = exponent - 0.75 * PROPORTIONAL
    onwards = PROPORTIONAL * memory - smooth * magnitude
    again = -exponent * magnitude
    factor = coarse_exp2(log2(SAFETY) + select_positive(good, onwards, again))
    factor = select_positive(good, factor, minimum(factor, 1.0))
    factor = select_positive(factor - LARGEST_CUT, factor, LARGEST_CUT)
    return minimum(factor, LARGEST_GROWTH)


def swings(first: Scalar, inside: Scalar, last: Scalar, share: float, weighed: Scalar) -> Scalar:
    """Return by how much a slope is elsewhere inside a step than at both ends, 0 if hardly.

    `inside` : the slope at a late stage, at a `share` of the step; `weighed` : step by tolerance. A
    smooth slope leaves the line between its ends by half of what these are apart only where it
    turns. Where stability limits the step, late stages swing in every step.
    """
    apart = last - first
    away = abs(inside - (first + share * apart))
    least = maximum(0.5 * abs(apart), SWING * (abs(first) + abs(last)))
    swing = away * abs(weighed)
    return select_positive(minimum(away - least, swing - NOTICED), swing, 0.0)


def jumps(first: Scalar, second: Scalar, mean: Scalar, last: Scalar, weighed: Scalar) -> Scalar:
    """Return by how much a slope is elsewhere on the mean of a step than at its ends, 0 if hardly.

    `second` : the slope at the second stage; `weighed` : step by tolerance. Where friction reverses
    at some stages and is back at the last one, their errors may cancel, and late stages look alike.
    """
    away = abs(mean - 0.5 * (first + last))
    off = away - JUMP * (abs(last - first) + abs(second - first))
    swing = off * abs(weighed)
    return select_positive(swing - NOTICED, swing, 0.0)


def contact_flags(
    v: Callable[[str], Expression], j: int, away: Expression, enclosure: str, method: Method
) -> tuple[Expression, ...]:
    """Flag a gap that closed, or perhaps did; and one in contact that opened, or perhaps did.

    Either may be over at the step's end, so both look at what is in between; but not where steps
    are fixed: there contacts change where a step ends. A gap whose journal stays in an enclosure
    off the wall did not close, and one in contact that stays in one beyond it did not open
    (`solver.kernels.emit.enclosure`, also of `away`). Steps that are long beside what a contact
    does in them have no enclosure there.
    """
    penetration, rate = v(f"penetration{j}"), v(f"penetration_rate{j}")
    start = v(f"penetration_start{j}")
    perhaps = dip = 0.0
    if method.error:
        held = "none" if method.watched_closely else enclosure
        perhaps = _where(ONSET, beyond(v, j, away, enclosure))
        dip = _where(RELEASE, may_open(v, j, away, held))
    onset = select_positive(penetration, ONSET, perhaps)
    opened = _where(RELEASE, maximum(-rate, start - LANDED))
    release = select_positive(penetration, dip, opened)
    touching = v(f"mode{j}")
    return select_positive(touching, 0.0, onset), _where(release, touching)


def passing_flag(v: Callable[[str], Expression], j: int, enclosure: str) -> Expression:
    """Flag a free journal whose normal turns much: it may pass the centre of its bearing."""
    touching = v(f"mode{j}")
    passing = _where(PASSING, whips_round(v, j)) if enclosure == "circle" else 0.0 * touching
    return select_positive(touching, 0.0, passing)


def _where(value: Scalar, *positive: Expression) -> Scalar:
    """Return a value where all of some expressions are positive, else 0."""
    for condition in positive:
        value = select_positive(condition, value, 0.0)
    return value
