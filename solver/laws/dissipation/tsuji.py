"""Tsuji's damping, whose restitution does not depend on speed."""

import math
from typing import Literal

from jointplay.solver.laws.dissipation.law import (
    Dissipation,
    EffectiveMass,
    Elastic,
    SomeRestitution,
)
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.quantities.scalars import Scalar, logarithm, sqrt


class Tsuji(Dissipation):
    """F_n = F_e + α sqrt(m F_e / δ) δ̇, α = -√5 ln e / sqrt(ln² e + π²), never pulling.

    F_e is the elastic force (N), δ the depth (m), δ̇ its rate (m/s), m the effective mass, e the
    restitution coefficient asked. With F_e = K δ^1.5 it is K δ^1.5 + α sqrt(m K) δ^0.25 δ̇.

    Assumes Hertz's exponent 1.5, and the mass that the contact feels. Fails as contact is let go
    where the force is zero, before the depth is: with α made for a release at depth zero, it
    delivers 0.550 for 0.5, 0.902 for 0.9. Good in lasting contact: there is no latched rate.

    Source: Tsuji, Tanaka and Ishida 1992, Powder Technol. 71:239; α of Antypov and Elliott 2011,
    EPL 94:50004.
    """

    law: Literal["tsuji"] = "tsuji"
    restitution: SomeRestitution
    effective_mass: EffectiveMass

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        lost = logarithm(self.restitution)
        factor = -math.sqrt(5.0) * lost / sqrt(lost * lost + math.pi * math.pi)
        return elastic.force + factor * sqrt(self.effective_mass * elastic.secant) * rate

    def jumps_at_onset(self, stiffness: Stiffness) -> bool:
        """Tell whether it does: where the stiffness is there at once."""
        return self.restitution < 1.0 and stiffness.is_stiff_at_once
