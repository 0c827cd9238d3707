"""Distance of two points: its direction and rate, guarded where they coincide."""

from typing import NamedTuple

from jointplay.solver.laws.force.law import Ends
from jointplay.solver.quantities.scalars import Scalar, sqrt

COINCIDENT = 1e-300
"""Added to the square of the distance (m^2), so that points that coincide divide by no zero."""


CHANNELS = (
    ("force", "N", "tension: positive pulls the points together"),
    ("length", "m", "distance of the points"),
    ("rate", "m/s", "rate of the distance"),
)
"""Name, unit and meaning of the channels of elements that act along the line between points."""


class Distance(NamedTuple):
    """Distance of the second of two points from the first."""

    length: Scalar
    """The distance, m."""
    direction: tuple[Scalar, Scalar]
    """Unit vector from the first point to the second; zero where they coincide."""
    rate: Scalar
    """Rate of the distance, m/s; zero there."""


def distance(ends: Ends) -> Distance:
    """Return the distance of two points, its direction and its rate."""
    (x, y), (vx, vy) = ends.gap, ends.rate
    square = x * x + y * y
    length = sqrt(square)
    inverse = length / (square + COINCIDENT)
    ux, uy = x * inverse, y * inverse
    return Distance(length, (ux, uy), ux * vx + uy * vy)
