"""Radzimovsky's line contact of a cylinder in a cylinder."""

import math
from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.logarithmic import Constants, Logarithmic

WIDTH = 1.6
"""b² = 1.6² F D / (E* L): the width of the contact (m) holds with D = D_i D_j / (D_i - D_j) of
diameters; with radii, as often copied, forces are 11 to 14 % low."""


class Radzimovsky(Logarithmic):
    """δ = F / (π E* L) (2/3 + ln(4 R_i / b) + ln(4 R_j / b)), b = 1.60 sqrt(F D / (E* L)).

    δ is the penetration depth (m), F the force (N), R_i and R_j the radii, L the bearing's width
    (m), b the width of the contact (m) and D = 2 R_i R_j / (R_i - R_j), of diameters.

    Assumes a contact that is narrow beside the radii. Fails for conformal contact: beyond a depth
    of 0.52 ΔR the force goes on along its tangent.

    Source: Radzimovsky 1953, University of Illinois Bulletin 408; b as in Roark, Formulas for
    Stress and Strain, table 33-2a.
    """

    law: Literal["radzimovsky"] = "radzimovsky"

    def constants(self, fit: Fit) -> Constants:
        """Return 1 / (π E* L), 16 R_i R_j F / b² and 2/3."""
        line = self.effective_modulus * fit.bearing_width
        b = 8.0 / (WIDTH * WIDTH) * line * fit.radial_clearance  # 16 R_i R_j / D is 8 ΔR
        return Constants(1.0 / (math.pi * line), b, 2.0 / 3.0)
