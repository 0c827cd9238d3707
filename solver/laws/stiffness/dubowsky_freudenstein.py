"""Dubowsky and Freudenstein's line contact of a cylinder in a cylinder."""

import math
from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.logarithmic import Constants, Logarithmic


class DubowskyFreudenstein(Logarithmic):
    """δ = F (h_i + h_j) / L (ln(L³ ΔR / (F R_i R_j (h_i + h_j))) + 1).

    δ is the penetration depth (m), F the force (N), L the bearing's width, R_i and R_j the radii,
    ΔR the radial clearance (m), h = (1 - ν²) / (π E) of each part (1/Pa).

    Assumes a bearing about as wide as its radius. Fails for narrow ones: the logarithm ends at a
    depth of ΔR L² / (R_i R_j), three quarters of which are used; from there on the force goes on
    along its tangent.

    Source: Dubowsky and Freudenstein 1971, J. Eng. Ind. 93:305, as in Pereira, Ramalho and Ambrosio
    2011.
    """

    law: Literal["dubowsky-freudenstein"] = "dubowsky-freudenstein"

    def constants(self, fit: Fit) -> Constants:
        """Return (h_i + h_j) / L, L³ ΔR / (R_i R_j (h_i + h_j)) and 1."""
        both, width = 2.0 * self.compliance / math.pi, fit.bearing_width
        journal_radius = fit.bearing_radius - fit.radial_clearance
        cube = width * width * width * fit.radial_clearance
        b = cube / (fit.bearing_radius * journal_radius * both)
        return Constants(both / width, b, 1.0)
