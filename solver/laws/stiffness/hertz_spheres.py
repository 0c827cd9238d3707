"""Hertz contact of spheres, with the stiffness of the press paper's eq. 9."""

from typing import Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.material import OfMaterial
from jointplay.solver.laws.stiffness.power import power_energy, power_slope
from jointplay.solver.quantities.scalars import Scalar, positive_part, power, sqrt

EXPONENT = 1.5


class HertzSpheres(OfMaterial):
    """F = K δ^1.5, K = 4 / (3 (h_i + h_j)) sqrt(R_i R_j / (R_i - R_j)), h = (1 - ν²) / E.

    δ is the penetration depth (m), R_i and R_j the radii of bearing and journal (m), both of one
    material.

    Assumes a ball in a spherical socket. Fails for journals: it ignores the bearing's width, and
    tends to zero with the clearance growing; at 1 µm in a bearing of 10 mm width it gives a tenth
    of what laws of line contact give.

    Source: Lankarani and Nikravesh 1990, as printed in the press paper (Meccanica 2022), eq. 9.
    """

    law: Literal["hertz-spheres"] = "hertz-spheres"

    def coefficient(self, fit: Fit) -> Scalar:
        """Return K of eq. (9), N/m^1.5, for a journal of radius R_j = R_i - c."""
        journal_radius = fit.bearing_radius - fit.radial_clearance
        radii = fit.bearing_radius * journal_radius / fit.radial_clearance
        return 4.0 / (3.0 * (self.compliance + self.compliance)) * sqrt(radii)

    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^1.5, N."""
        return self.coefficient(fit) * power(positive_part(depth), EXPONENT)

    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^2.5 / 2.5, J."""
        return power_energy(self.force(fit, depth), depth, EXPONENT)

    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return 1.5 K δ^0.5, N/m."""
        return power_slope(self.force(fit, depth), depth, EXPONENT)
