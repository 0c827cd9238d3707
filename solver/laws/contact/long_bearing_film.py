"""A long bearing's film of oil, and dry contact where it ends."""

from typing import Literal

from jointplay.solver.laws.contact.film import Pair, around_film_integrals
from jointplay.solver.laws.contact.oil_film import OilFilm
from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import Scalar


class LongBearingFilm(OilFilm):
    """F = -12 μ L R³ / c³ V ∫ (sin φ - k) (s sin φ - q cos φ) / H³ dφ, φ from -π/2 to π/2.

    V s is the journal's velocity in axes that turn with the mean of both spins (V its magnitude, q
    to the left of its direction s), H = 1 - e·(s cos φ + q sin φ) / c the film's thickness over the
    radial clearance c, e the eccentricity, μ the viscosity, L the bearing's width, R its radius, k
    the mean of sin φ with the weights 1 / H³, which makes the pressure zero at both ends of the
    film. Rotation, and a film thinner than the boundary layer, are as in a short bearing.

    Assumes oil of one viscosity that flows around the journal only, as in a bearing much wider than
    its radius (L / 2R above 2) without grooves. Fails for shorter bearings, whose force is smaller
    than this; where oil does not begin and end at right angles to the velocity, as in a film that
    ruptures behind the narrowest place; for oil that heats up or starves; and within the boundary
    layer, where it joins film and contact only.

    Source: Sommerfeld 1904, Z. Math. Phys. 50:97 (the long bearing), with the half film of Gümbel
    for a velocity in any direction. The force on a journal that turns in one place is theirs.
    """

    law: Literal["long-bearing-film"] = "long-bearing-film"  # type: ignore[assignment]

    def pressed_area(self, fit: Fit) -> Scalar:
        """Return 12 R²: oil leaves at the ends of the film."""
        return 12.0 * fit.bearing_radius * fit.bearing_radius

    def pressure_integrals(self, x: Scalar, y: Scalar) -> Pair:
        """Return the variance of sin, and less its covariance with cos, weighed with 1 / H³."""
        return around_film_integrals(x, y)
