"""Knots of functions that are given piece by piece: their rules, and arguments beyond them."""

import math
from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from jointplay.solver.laws.function.law import Derivatives
from jointplay.solver.quantities.scalars import (
    Scalar,
    floor,
    knotted,
    maximum,
    minimum,
    select_positive,
)
from jointplay.solver.quantities.units import Rule, quantity

MOST_KNOTS = 64
BENDS = 4.0
"""Distances of knots that a wave through them is at least long."""
UNEVEN = 1e4
"""Largest ratio of distances of knots: a spline through more uneven ones overshoots wildly."""
SLACK = 1e-9
"""Share of the span by which rounding may pass an end beyond which arguments are refused."""

Knots = Annotated[
    list[Annotated[float, quantity("unit of x", ge=-1e9, le=1e9)]],
    Field(min_length=2, max_length=MOST_KNOTS),
]
Outside = Literal["held", "periodic", "refused"]
"""Continuation beyond the knots: the end values, the same again, or the end of the run."""


def _gaps(function: Any) -> list[Any]:
    return [after - before for before, after in pairwise(function.knots)]


def least_gap(function: Any) -> Any:
    """Return the shortest distance of knots."""
    gaps = [np.asarray(gap) for gap in np.broadcast_arrays(*_gaps(function))]
    return np.min(np.stack(gaps), axis=0)


def _falling(function: Any) -> str:
    k = next(k for k, gap in enumerate(_gaps(function), start=1) if gap <= 0.0)
    return (
        f"Knot {k} is {function.knots[k]:g}, not above {function.knots[k - 1]:g} before it; knots"
        " must grow strictly."
    )


def _ratio(function: Any) -> Any:
    gaps = np.stack(np.broadcast_arrays(*_gaps(function)))
    return gaps.max(axis=0) / np.maximum(gaps.min(axis=0), 1e-300)


GROWING = (
    Rule("knots", lambda function: least_gap(function) <= 0.0, _falling),
    Rule(
        "knots",
        lambda function: (least_gap(function) > 0.0) & (_ratio(function) > UNEVEN),
        lambda function: (
            f"The widest distance of knots is {_ratio(function):.3g} times the narrowest; at most"
            f" {UNEVEN:g} times is followed. Space them more evenly."
        ),
    ),
)


def noted(found: Derivatives, x: Scalar, function: Any, *, bent: bool) -> Derivatives:
    """Return a function's value and derivatives at x, with its knots noted for the steps.

    `bent` : the second derivative may jump at knots.
    """
    knots = function.knots
    span = knots[-1] - knots[0] if function.outside == "periodic" else None
    value, slope, curvature = (knotted(part, x, knots, span) for part in found)
    if bent:
        curvature = knotted(curvature, x, knots, span, jumps=True)
    return Derivatives(value, slope, curvature)


def brought_inside(x: Scalar, first: Scalar, last: Scalar, outside: Outside) -> Scalar:
    """Return the argument between the first and the last knot that stands for another one.

    Not a number where that is refused: steps end before it.
    """
    if outside == "periodic":
        return x - (last - first) * floor((x - first) / (last - first))
    inside = minimum(maximum(x, first), last)
    if outside == "held":
        return inside
    beyond = maximum(first - x, x - last) - SLACK * (last - first)
    return select_positive(beyond, math.nan, inside)
