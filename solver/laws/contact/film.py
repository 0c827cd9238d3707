"""Film of oil between journal and bearing: what it exerts, and the integrals of short ones."""

from typing import NamedTuple

from jointplay.solver.quantities.scalars import Scalar, direction_angle, sqrt

Pair = tuple[Scalar, Scalar]


class Film(NamedTuple):
    """Action of a film at one instant, world components."""

    force: Pair
    """Force on the journal at its centre, N; the opposite acts on the bearing at its own."""
    moment_on_journal: Scalar
    """Moment on the journal's body besides, N m."""
    moment_on_bearing: Scalar
    """Moment on the bearing's body besides, N m."""
    loss: Scalar
    """Power that goes into the film, never negative, W."""


def half_film_integrals(x: Scalar, y: Scalar) -> Pair:
    """Return ∫ cos² / h³ and ∫ cos sin / h³ over φ from -π/2 to π/2, h = 1 - x cos φ - y sin φ.

    These are half the second derivatives, by x twice and by x and y, of ∫ 1 / h = 2 A / D, with
    D² = 1 - x² - y² and A the angle of (-x, D). The point (x, y) is inside of the unit circle.
    """
    square = 1.0 - x * x - y * y
    inverse = 1.0 / square
    root = sqrt(square)
    angle = direction_angle(-x, root) * (inverse / root)
    first = 3.0 * x * (inverse * inverse) + angle * (1.0 + 3.0 * (x * x) * inverse)
    bent = (2.0 + x * x / (square + x * x)) * inverse + 3.0 * angle * x
    return first, y * inverse * bent
