"""Shared parts of friction laws that hold a joint at rest harder than a sliding one."""

from typing import Annotated, ClassVar

from jointplay.solver.laws.friction.law import FrictionLaw
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, quantity

Coefficient = Annotated[float, quantity("1", gt=0.0, le=10.0)]
SlipSpeed = Annotated[float, quantity("m/s", gt=0.0, le=1e3)]


class Breakaway(FrictionLaw):
    """Friction with a static and a kinetic coefficient."""

    static_coefficient: Coefficient
    kinetic_coefficient: Coefficient
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "kinetic_coefficient",
            lambda law: law.kinetic_coefficient > law.static_coefficient,
            lambda law: (
                f"The kinetic coefficient ({law.kinetic_coefficient:g}) is above the static one"
                f" ({law.static_coefficient:g}); it may at most equal it."
            ),
        ),
    )

    @property
    def surplus(self) -> Scalar:
        """The static coefficient less the kinetic one, 1."""
        return self.static_coefficient - self.kinetic_coefficient
