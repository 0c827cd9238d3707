"""Kelvin-Voigt: a viscous damper beside the elastic force."""

from typing import Annotated, Literal

from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.quantities.scalars import Scalar, select_positive
from jointplay.solver.quantities.units import quantity


class KelvinVoigt(Dissipation):
    """F_n = F_e + D δ̇, never pulling.

    F_e is the elastic force (N), δ̇ the rate (m/s), D the damping.

    Assumes a damper that is there at any depth. Fails at onsets, where the force jumps by D δ̇, and
    no exponent is known for that; contact is let go before the depth is zero, for it never pulls.

    Source: Goldsmith 1960, Impact.
    """

    law: Literal["kelvin-voigt"] = "kelvin-voigt"
    damping: Annotated[float, quantity("N s/m", ge=0.0, le=1e12, description="D")]

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        return select_positive(elastic.depth, elastic.force + self.damping * rate, 0.0)

    def jumps_at_onset(self, stiffness: Stiffness) -> bool:
        """Unless there is no damping."""
        return self.damping > 0.0
