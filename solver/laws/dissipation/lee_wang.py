"""Lee and Wang's damping."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import Restitution
from jointplay.solver.quantities.scalars import Scalar


class LeeWang(Latched):
    """χ = 3 (1 - e) / 4.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes nearly elastic
    impacts. Fails for every e below one: half of what is asked is lost, 0.952 delivered for 0.9,
    0.799 for 0.5; and in lasting contact, where the rate latched at the last onset scales the
    damping.

    Source: Lee and Wang 1983, J. Mech. Des. 105:209.
    """

    law: Literal["lee-wang"] = "lee-wang"
    restitution: Restitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return 0.75 * (1.0 - self.restitution)
