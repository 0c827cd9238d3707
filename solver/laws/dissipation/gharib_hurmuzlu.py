"""Gharib and Hurmuzlu's damping."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import SomeRestitution
from jointplay.solver.quantities.scalars import Scalar


class GharibHurmuzlu(Latched):
    """χ = 1 / e.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes impacts that lose
    nearly all. Fails for e above 0.3: it delivers 0.411 for 0.5, 0.567 for 0.9; and in lasting
    contact, where the rate latched at the last onset scales the damping.

    Source: Gharib and Hurmuzlu 2012, J. Appl. Mech. 79:064506.
    """

    law: Literal["gharib-hurmuzlu"] = "gharib-hurmuzlu"
    restitution: SomeRestitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return 1.0 / self.restitution
