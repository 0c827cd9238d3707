"""Zhiying and Qishao's damping."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import Restitution
from jointplay.solver.quantities.scalars import Scalar, exponential


class ZhiyingQishao(Latched):
    """χ = 3 (1 - e²) exp(2 (1 - e)) / 4.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes a fitted
    exponential. Fails for small e: it delivers 0.483 for 0.5, but 0.218 for 0.1; and in lasting
    contact, where the rate latched at the last onset scales the damping.

    Source: Zhiying and Qishao 2006.
    """

    law: Literal["zhiying-qishao"] = "zhiying-qishao"
    restitution: Restitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        lost = 1.0 - self.restitution * self.restitution
        return 0.75 * lost * exponential(2.0 * (1.0 - self.restitution))
