"""Bounds on what happens inside a step: how far bodies turn in it, how far journals move in it.

In free flight the local error vanishes, so that it says nothing of a step's length; what forces do
not limit, geometry must. Three rules make a step's inside known from its ends:

1. No body turns by more than `TURN` in a step (`longest`).
2. A journal's centre moves along the quintic that has its position, velocity and acceleration at
   both ends of the step. As a Bezier curve it lies in the hull of its six control points, and a
   disc is convex: a journal whose control points are all inside its clearance circle does not touch
   within the step (`beyond`). What the quintic leaves out is at most h^6 |e^(6)| / 46080
   (Hermite's remainder). An eccentricity is a sum of vectors that turn with bodies and of paths of
   free bodies, which gravity makes parabolas. If k derivatives of an angle are worth at most
   turn^k each (turn: |omega| h or sqrt(|alpha|) h, whichever is more), the sixth of a vector of
   length r is worth 203 r turn^6, for 203 is the number of partitions of six.
3. A journal in contact stays so if a straight line parts the six points from the clearance circle
   (`may_open`): the tangent at the normal in the middle between those at both ends.
"""

from collections.abc import Callable, Iterable
from functools import reduce
from operator import add

from jointplay.solver.kernels.layout import MOTION, Layout
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.scalars import (
    SLIGHT,
    greatest,
    maximum,
    minimum,
    sine_cosine,
    sqrt,
)

TURN = 0.5
"""Largest angle by which a body may turn in a step, rad."""
REMAINDER = 203.0 / 46080.0
SKIN = 1e-3
"""Share of the clearance that an enclosure keeps from the wall, for what forces do to the sixth
derivative: a hundred times the local error of a step at the largest tolerance."""
HELD = 0.1
"""The same in contact, where depths are small, in tolerances: of the clearance, as errors are."""
WHIP = 0.5
"""Angle of a normal in a step, rad, beyond which channels that follow it are looked at closely."""
_, COSINE = sine_cosine(WHIP)
PATHS = ("eccentricity_start", "eccentricity")


def allocate(layout: Layout, pairs: int) -> None:
    """Give slots to the motion of journals at both ends of a step, and to what bounds it.

    ``inner`` is the radius that a journal's enclosure must not exceed, m, ``outer`` the one that it
    must be beyond in contact; ``lever`` the size of the mechanism, m; ``driven_speed`` the sum of
    all drivers' angular speeds, rad/s.
    """
    layout.add("lever", "driven_speed")
    layout.add_block("inner", pairs)
    layout.add_block("outer", pairs)
    for name in PATHS:
        layout.add_block(name, MOTION * pairs)


def longest(v: Callable[[str], Expression], speeds: Iterable[str]) -> Expression:
    """Return the longest step in which no body turns by more than `TURN`, s.

    speeds : slots of the angular speeds of all bodies that no driver turns.
    """
    driven = v("driven_speed")
    return TURN / (greatest(abs(v(name)) for name in speeds) + driven + SLIGHT)


def remainder(
    v: Callable[[str], Expression], speeds: Iterable[str], accelerations: Iterable[str]
) -> Expression:
    """Return what a journal may be away from the quintic, m.

    Parameters
    ----------
    speeds, accelerations
        Slots of those of angles, at both ends of the step.
    """
    tried, driven = v("tried"), v("driven_speed")
    fastest = greatest((abs(v(name)) + driven for name in speeds), driven)
    hardest = greatest(abs(v(name)) for name in accelerations)
    square = tried * tried * maximum(fastest * fastest, hardest)
    return REMAINDER * v("lever") * square * square * square


def beyond(v: Callable[[str], Expression], j: int, away: Expression, enclosure: str) -> Expression:
    """Return a number that is positive unless pair j surely stays apart all the step.

    Of the control points the first and the last are the ends of the step, whose gaps are known.

    Parameters
    ----------
    away
        What the pair may be away from the quintic, m.
    enclosure
        What its points are compared with, see `Contact`.
    """
    if enclosure == "none":
        return v("tried")
    points = _between(v, j)
    if enclosure == "wall":
        return reduce(maximum, points[0]) + away - v(f"inner{j}")
    square = greatest(x * x + y * y for x, y in zip(*points, strict=True))
    inner = maximum(v(f"inner{j}") - away, 0.0)
    return square - inner * inner


def may_open(
    v: Callable[[str], Expression], j: int, away: Expression, enclosure: str
) -> Expression:
    """Return a number that is positive unless pair j, closed at both ends, surely is all the step.

    Parameters as `beyond` has them. The points at the ends count, too: what a straight line parts
    from a disc includes the way to the next point.
    """
    if enclosure == "none":
        return v("tried")
    points, outer = _between(v, j), v(f"outer{j}") + away
    if enclosure == "wall":
        return outer - reduce(minimum, points[0])
    ends = [[v(f"{block}{MOTION * j + axis}") for block in PATHS] for axis in range(2)]
    x, y = (first + last for first, last in ends)
    along = [x * px + y * py for px, py in zip(*map(add, ends, points), strict=True)]
    nearest = maximum(reduce(minimum, along), 0.0)
    return outer * outer * (x * x + y * y) - nearest * nearest


def _between(v: Callable[[str], Expression], j: int) -> list[list[Expression]]:
    """Return x and y of the control points of pair j's quintic but for its ends, m."""
    step = v("tried")
    points: list[list[Expression]] = []
    for axis in range(2):
        between = []
        for block, sense in zip(PATHS, (1.0, -1.0), strict=True):
            position, rate, bend = (v(f"{block}{MOTION * j + axis + 2 * k}") for k in range(3))
            fifth = 0.2 * sense * step * rate
            between += [position + fifth, position + 2.0 * fifth + 0.05 * step * step * bend]
        points.append(between)
    return points


def whips_round(v: Callable[[str], Expression], j: int) -> Expression:
    """Return a number that is positive where pair j's normal turns by more than `WHIP`."""
    start, end = ([v(f"{block}{MOTION * j + axis}") for axis in range(2)] for block in PATHS)
    together = start[0] * end[0] + start[1] * end[1]
    first, last = (x * x + y * y for x, y in (start, end))
    return COSINE * sqrt(first * last) - together
