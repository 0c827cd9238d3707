"""Safaeifar and Farshidianfar's damping."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import SomeRestitution
from jointplay.solver.quantities.scalars import Scalar


class SafaeifarFarshidianfar(Latched):
    """χ = 5 (1 - e) / (4 e).

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes a depth over time
    like that of an elastic impact. Fails by up to 0.04: it delivers 0.536 for 0.5, 0.915 for 0.9;
    and in lasting contact, where the rate latched at the last onset scales the damping.

    Source: Safaeifar and Farshidianfar 2020, Multibody Syst. Dyn., doi 10.1007/s11044-020-09732-2.
    """

    law: Literal["safaeifar-farshidianfar"] = "safaeifar-farshidianfar"
    restitution: SomeRestitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return 1.25 * (1.0 - self.restitution) / self.restitution
