"""A short bearing's film of oil, and dry contact where it ends."""

from typing import Literal

from jointplay.solver.laws.contact.film import Pair, half_film_integrals
from jointplay.solver.laws.contact.oil_film import OilFilm
from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import Scalar


class ShortBearingFilm(OilFilm):
    """F = -μ L³ R / c³ V ∫ cos φ (s cos φ + q sin φ) / H³ dφ, φ from -π/2 to π/2.

    V s is the journal's velocity in axes that turn with the mean of both spins (V its magnitude, q
    to the left of its direction s), H = 1 - e·(s cos φ + q sin φ) / c the film's thickness over the
    radial clearance c, e the eccentricity, μ the viscosity, L the bearing's width, R its radius.
    Rotation is resisted by 2 π μ R³ L Δω / sqrt(c² - e²). At a thickness below the boundary layer
    the film keeps the force of that thickness and fades to nothing where the surfaces meet, by
    a smooth step; there dry contact begins, of a stiffness and a dissipation law.

    Assumes oil of one viscosity in a bearing much shorter than wide (L / 2R below 1/2), pressed at
    its ends by air alone, which bears where it is squeezed and leaves the half where pressure would
    be negative (Gümbel). Fails for wide bearings, whose force is smaller than this; for oil that
    heats up or starves; and within the boundary layer, where it joins film and contact only.

    Source: Ocvirk 1952, NACA TN 2808 (the short bearing; half film after Gümbel), and Flores,
    Ambrósio, Claro, Lankarani and Koshy 2006, Mech. Mach. Theory 41:247 (the transition, there a
    straight line).
    """

    law: Literal["short-bearing-film"] = "short-bearing-film"  # type: ignore[assignment]

    def pressed_area(self, fit: Fit) -> Scalar:
        """Return L²: oil leaves at the bearing's ends."""
        return fit.bearing_width * fit.bearing_width

    def pressure_integrals(self, x: Scalar, y: Scalar) -> Pair:
        """Return ∫ cos² / H³ and ∫ cos sin / H³."""
        return half_film_integrals(x, y)
