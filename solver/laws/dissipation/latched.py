"""Shared parts of laws whose damping is a multiple of the elastic force, by the impact rate."""

from abc import abstractmethod
from typing import Annotated

from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import quantity

ImpactRateFloor = Annotated[
    float | None,
    quantity(
        "m/s",
        gt=0.0,
        le=1e3,
        description="smallest impact rate that the damping divides by; none: a hundred thousandth"
        " of the scene's speed, at most 1e-3 m/s",
    ),
]


class Latched(Dissipation):
    """F_n = F_e (1 + χ δ̇ / δ̇⁻), χ a function of the restitution coefficient alone.

    F_e is the elastic force (N), δ̇ the rate (m/s), δ̇⁻ that at the onset of this contact, latched.
    What such a law delivers in a free impact does not depend on stiffness, mass or speed; with
    χ (1 + e) = ln((1 + χ) / (1 - χ e)) from the integral of energy, e is what it delivers.
    """

    impact_rate_floor: ImpactRateFloor = None

    @abstractmethod
    def hysteresis(self) -> Scalar:
        """Return χ, 1."""

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        return elastic.force * (1.0 + self.hysteresis() * rate / impact_rate)

    @property
    def least_impact_rate(self) -> float | None:
        """The floor, m/s, if it is given."""
        return self.impact_rate_floor
