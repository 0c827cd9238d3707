"""The IMPACT function of ADAMS."""

from typing import Annotated, Literal

from jointplay.solver.laws.contact.law import ContactLaw
from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.power import Exponent, GivenStiffness
from jointplay.solver.quantities.scalars import Scalar, clamp_to_unit, positive_part, power
from jointplay.solver.quantities.units import quantity


class AdamsImpact(ContactLaw):
    """F_n = K δ^n + STEP(δ, 0, 0, d, C) δ̇, never pulling.

    δ is the penetration depth (m), δ̇ its rate (m/s); the damping grows from 0 to C over the depth
    d as a cubic, x² (3 - 2 x) with x = δ / d limited to 0..1.

    Assumes numbers that were fitted to impacts at one speed. Fails to deliver one restitution: it
    depends on speed, mass and stiffness. Good in lasting contact: there is no latched rate.

    Source: MSC Software 2013, Adams/Solver help, functions IMPACT and STEP.
    """

    law: Literal["adams-impact"] = "adams-impact"
    stiffness: GivenStiffness
    exponent: Exponent = 1.5
    damping: Annotated[float, quantity("N s/m", ge=0.0, le=1e12, description="C")]
    full_damping_depth: Annotated[float, quantity("m", gt=0.0, le=1.0, description="d")]

    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        x = clamp_to_unit(depth / self.full_damping_depth)
        damping = self.damping * (x * x * (3.0 - 2.0 * x))
        return positive_part(self._elastic_force(depth) + damping * rate)

    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^(n+1) / (n + 1), J."""
        return self._elastic_force(depth) * positive_part(depth) / (self.exponent + 1.0)

    @property
    def needs_radii(self) -> bool:
        """No: its stiffness is given."""
        return False

    def _elastic_force(self, depth: Scalar) -> Scalar:
        return self.stiffness * power(positive_part(depth), self.exponent)
