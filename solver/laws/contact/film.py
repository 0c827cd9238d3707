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


def around_film_integrals(x: Scalar, y: Scalar) -> Pair:
    """Return ∫ (sin - k) sin / h³ and -∫ (sin - k) cos / h³, k = ∫ sin / h³ over ∫ 1 / h³.

    φ and h as above. Besides half the second derivatives, ∫ sin / h³ and ∫ cos / h³ follow from the
    first ones, ∫ sin / h² and ∫ cos / h², by 1 / h² = h / h³.
    """
    cos_cos, cos_sin = half_film_integrals(x, y)
    beside = 1.0 - y * y
    square = beside - x * x
    inverse, inverse_beside = 1.0 / square, 1.0 / beside
    root = sqrt(square)
    angle = direction_angle(-x, root) * (inverse / root)
    end = x * inverse_beside * inverse
    bent = 3.0 * (y * y) * inverse
    sin_sin = end * (1.0 + 2.0 * (y * y) * inverse_beside + bent) + angle * (1.0 + bent)
    sin = 2.0 * y * (end + angle) + x * cos_sin + y * sin_sin
    cos = 2.0 * (inverse + x * angle) + x * cos_cos + y * cos_sin
    mean = sin / (cos_cos + sin_sin)
    return sin_sin - mean * sin, mean * cos - cos_sin
