"""Herbert and McWhannell's damping."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import Restitution
from jointplay.solver.quantities.scalars import Scalar


class HerbertMcWhannell(Latched):
    """χ = 6 (1 - e) / ((2 e - 1)² + 3).

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes nearly elastic
    impacts. Fails for small e: it delivers 0.594 for 0.5, 0.491 for 0.1; and in lasting contact,
    where the rate latched at the last onset scales the damping.

    Source: Herbert and McWhannell 1977, J. Eng. Ind. 99:795.
    """

    law: Literal["herbert-mcwhannell"] = "herbert-mcwhannell"
    restitution: Restitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        twice = 2.0 * self.restitution - 1.0
        return 6.0 * (1.0 - self.restitution) / (twice * twice + 3.0)
