"""The line contact of a cylinder in a cylinder of ESDU 78035."""

import math
from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.logarithmic import Constants, Logarithmic


class Esdu78035(Logarithmic):
    """δ = F (h_i + h_j) / L (ln(4 L ΔR / (F (h_i + h_j))) + 1).

    δ is the penetration depth (m), F the force (N), L the bearing's width, ΔR the radial clearance
    (m), h = (1 - ν²) / (π E) of each part (1/Pa).

    Assumes a contact that is narrow beside the radii. Fails for conformal contact: it has no end
    before a depth of 4 ΔR, which no line contact has. Papers print a π before F as well, which the
    definition of h holds already: with it, forces are a quarter of those of other laws.

    Source: ESDU 78035, 1978, as in Pereira, Ramalho and Ambrosio 2011, without that π; the
    item itself was not at hand.
    """

    law: Literal["esdu-78035"] = "esdu-78035"

    def constants(self, fit: Fit) -> Constants:
        """Return (h_i + h_j) / L, 4 L ΔR / (h_i + h_j) and 1."""
        both, width = 2.0 * self.compliance / math.pi, fit.bearing_width
        return Constants(both / width, 4.0 * width * fit.radial_clearance / both, 1.0)
