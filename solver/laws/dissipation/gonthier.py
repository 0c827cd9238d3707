"""Gonthier's damping, in its explicit approximation."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import SomeRestitution
from jointplay.solver.quantities.scalars import Scalar


class Gonthier(Latched):
    """χ = (1 - e²) / e.

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). Assumes the approximation d
    = 1 - e² of the factor that Gonthier defines by an equation; solved exactly, it is the law
    `exact`. Fails by up to 0.03: it delivers 0.488 for 0.5, 0.876 for 0.9; and in lasting contact,
    where the rate latched at the last onset scales the damping.

    Source: Gonthier, McPhee, Lange and Piedboeuf 2004, Multibody Syst. Dyn. 11:209.
    """

    law: Literal["gonthier"] = "gonthier"
    restitution: SomeRestitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        return (1.0 - self.restitution * self.restitution) / self.restitution
