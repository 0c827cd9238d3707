"""Interface of dissipation laws: what the rate adds to the elastic force."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.laws.stiffness.power import NOTHING
from jointplay.solver.quantities.scalars import Scalar, positive_part
from jointplay.solver.quantities.units import Rule, Strict, quantity

Restitution = Annotated[float, quantity("1", ge=0.0, le=1.0)]
SomeRestitution = Annotated[float, quantity("1", ge=1e-3, le=1.0)]
"""Restitution of laws that divide by it, or take its logarithm."""
EffectiveMass = Annotated[
    float,
    quantity(
        "kg",
        gt=0.0,
        le=1e9,
        description="m_i m_j / (m_i + m_j) of the bodies as they feel at the contact",
    ),
]


@dataclass(frozen=True)
class Elastic:
    """The elastic part of a contact at one depth (m)."""

    law: Stiffness
    fit: Fit
    depth: Scalar

    @property
    def force(self) -> Scalar:
        """The force F_e, N."""
        return self.law.force(self.fit, self.depth)

    @property
    def slope(self) -> Scalar:
        """The derivative dF_e/dδ, N/m."""
        return self.law.slope(self.fit, self.depth)

    @property
    def secant(self) -> Scalar:
        """F_e / δ, N/m; 0 at depth 0."""
        return self.force / (positive_part(self.depth) + NOTHING)


class Dissipation(Strict):
    """The damping of a contact: resists while approaching, and lowers the force while parting.

    Rates are positive while approaching, m/s.
    """

    law: str
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""

    @abstractmethod
    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return the normal force with its damping, N; what would pull is left out by the contact.

        `impact_rate` is the rate at the onset of this contact, at least `least_impact_rate`, m/s.
        """

    @property
    def least_impact_rate(self) -> float | None:
        """Floor under the impact rate that an onset latches, m/s.

        0 for laws without memory; none: a share of the scene's speed.
        """
        return 0.0

    def jumps_at_onset(self, stiffness: Stiffness) -> bool:
        """Tell whether the force jumps where a contact begins."""
        return False
