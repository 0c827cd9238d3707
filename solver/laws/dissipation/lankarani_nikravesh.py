"""Lankarani and Nikravesh's damping: the paper's eq. 10."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import Restitution
from jointplay.solver.quantities.scalars import Scalar


class LankaraniNikraveshDamping(Latched):
    """χ = 3 (1 - e²) / 4.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes short, nearly
    elastic impacts. Fails for small e: it delivers 0.725 for 0.5, 0.913 for 0.9; and in lasting
    contact, where the rate latched at the last onset scales the damping.

    Source: Lankarani and Nikravesh 1990, J. Mech. Des. 112:369, as printed in the press paper
    (Meccanica 2022), eq. 10.
    """

    law: Literal["lankarani-nikravesh"] = "lankarani-nikravesh"
    restitution: Restitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return 0.75 * (1.0 - self.restitution * self.restitution)
