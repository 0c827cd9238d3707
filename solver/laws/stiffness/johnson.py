"""Johnson's line contact of a cylinder in a cylinder."""

import math
from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.logarithmic import Constants, Logarithmic


class Johnson(Logarithmic):
    """δ = F / (π E* L) (ln(4 π E* L ΔR / F) - 1).

    δ is the penetration depth (m), F the force (N), L the bearing's width, ΔR the radial clearance
    (m), 1 / E* = 2 (1 - ν²) / E.

    Assumes a contact that is narrow beside the radii. Fails for conformal contact: beyond a depth
    of 0.40 ΔR the force goes on along its tangent (at 0.54 ΔR the formula would end).

    Source: Johnson 1985, Contact Mechanics; as in Pereira, Ramalho and Ambrosio 2011.
    """

    law: Literal["johnson"] = "johnson"

    def constants(self, fit: Fit) -> Constants:
        """Return 1 / (π E* L), 4 π E* L ΔR and -1."""
        stiffness = math.pi * self.effective_modulus * fit.bearing_width
        return Constants(1.0 / stiffness, 4.0 * stiffness * fit.radial_clearance, -1.0)
