"""A force that grows as a power of the depth, its stiffness given."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.law import Stiffness
from jointplay.solver.quantities.scalars import Scalar, positive_part, power
from jointplay.solver.quantities.units import quantity

GivenStiffness = Annotated[float, quantity("N/m^n", gt=0.0, le=1e18, description="K")]
Exponent = Annotated[float, quantity("1", ge=1.0, le=3.0, description="n", structural=[1.5])]
NOTHING = 1e-300
"""Added to a depth (m), so that none divides by no zero."""


def power_energy(force: Scalar, depth: Scalar, exponent: Scalar) -> Scalar:
    """Return F δ / (n + 1), J, of a force K δ^n."""
    return force * positive_part(depth) / (exponent + 1.0)


def power_slope(force: Scalar, depth: Scalar, exponent: Scalar) -> Scalar:
    """Return n F / δ, N/m, of a force K δ^n."""
    return exponent * force / (positive_part(depth) + NOTHING)


class Power(Stiffness):
    """F = K δ^n.

    δ is the penetration depth (m), K the stiffness, n the exponent.

    Assumes that K and n were fitted or computed for this pair. Fails outside of the loads that they
    were fitted to.

    Source: Hertz 1882 for n = 1.5; any n: Lankarani and Nikravesh 1990, as printed in the press
    paper (Meccanica 2022), eq. 8.
    """

    needs_radii: ClassVar[bool] = False

    law: Literal["power"] = "power"
    stiffness: GivenStiffness
    exponent: Exponent = 1.5

    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^n, N."""
        return self.stiffness * power(positive_part(depth), self.exponent)

    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^(n+1) / (n + 1), J."""
        return power_energy(self.force(fit, depth), depth, self.exponent)

    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return n K δ^(n-1), N/m."""
        return power_slope(self.force(fit, depth), depth, self.exponent)

    @property
    def is_stiff_at_once(self) -> bool:
        """True where n is 1."""
        return self.exponent == 1.0
