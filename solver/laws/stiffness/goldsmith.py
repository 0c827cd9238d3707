"""Goldsmith's line contact of a cylinder in a cylinder."""

import math
from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.logarithmic import Constants, Logarithmic


class Goldsmith(Logarithmic):
    """δ = F (h_i + h_j) / L (ln(L / (F R (h_i + h_j))) + 1), R = R_i R_j / (R_i - R_j).

    δ is the penetration depth (m), F the force (N), L the bearing's width (m), h = (1 - ν²) / (π E)
    of each part (1/Pa).

    Assumes SI units: the argument of the logarithm has the dimension 1/m as it is published, so the
    numbers hold in metres only. Fails for a law of physics by that, and for conformal contact.

    Source: Goldsmith 1960, Impact, with exponent m = 1, as in Pereira, Ramalho and Ambrosio 2011.
    """

    law: Literal["goldsmith"] = "goldsmith"

    def constants(self, fit: Fit) -> Constants:
        """Return (h_i + h_j) / L, L / (R (h_i + h_j)) in SI units, and 1."""
        both = 2.0 * self.compliance / math.pi
        journal_radius = fit.bearing_radius - fit.radial_clearance
        inverse = fit.radial_clearance / (fit.bearing_radius * journal_radius)
        return Constants(both / fit.bearing_width, fit.bearing_width * inverse / both, 1.0)
