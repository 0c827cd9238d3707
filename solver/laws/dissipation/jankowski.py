"""Jankowski's damping: while approaching only."""

import math
from typing import Literal

from jointplay.solver.laws.dissipation.law import (
    Dissipation,
    EffectiveMass,
    Elastic,
    SomeRestitution,
)
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.quantities.scalars import Scalar, positive_part, sqrt


class Jankowski(Dissipation):
    """F_n = F_e + 2 ξ sqrt(m F_e / δ) δ̇ while approaching, F_n = F_e while parting.

    F_e is the elastic force (N), δ the depth (m), δ̇ its rate (m/s), m the effective mass;
    ξ = 9 √5 / 2 (1 - e²) / (e (e (9 π - 16) + 16)), e the restitution coefficient asked. With
    F_e = K δ^1.5 the damping is 2 ξ sqrt(m K) δ^0.25 δ̇.

    Assumes Hertz's exponent 1.5, and the mass that the contact feels. Fails by 0.01: it delivers
    0.495 for 0.5, 0.900 for 0.9; the damping has a kink where the rate turns. Good in lasting
    contact: there is no latched rate.

    Source: Jankowski 2005, Earthq. Eng. Struct. Dyn. 34:595 (the force), and 2006, 35:517 (ξ).
    """

    law: Literal["jankowski"] = "jankowski"
    restitution: SomeRestitution
    effective_mass: EffectiveMass

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        e = self.restitution
        share = (1.0 - e * e) / (e * (e * (9.0 * math.pi - 16.0) + 16.0))
        critical = 2.0 * sqrt(self.effective_mass * elastic.secant)
        damping = 4.5 * math.sqrt(5.0) * share * critical
        return elastic.force + damping * positive_part(rate)

    def jumps_at_onset(self, stiffness: Stiffness) -> bool:
        """Tell whether it does: where the stiffness is there at once."""
        return self.restitution < 1.0 and stiffness.is_stiff_at_once
