"""Hunt and Crossley's damping, with the impact rate latched."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import Restitution
from jointplay.solver.quantities.scalars import Scalar


class HuntCrossley(Latched):
    """χ = 3 (1 - e) / 2.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes nearly elastic
    impacts. Fails for small e: it delivers 0.663 for 0.5, 0.516 for 0.1; and in lasting contact,
    where the rate latched at the last onset scales the damping.

    Source: Hunt and Crossley 1975, J. Appl. Mech. 42:440.
    """

    law: Literal["hunt-crossley"] = "hunt-crossley"
    restitution: Restitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return 1.5 * (1.0 - self.restitution)
