"""Modified Coulomb friction: the paper's eqs 11-12."""

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from jointplay.solver.laws.friction.law import FrictionLaw
from jointplay.solver.quantities.scalars import (
    Scalar,
    absolute,
    clamp_to_unit,
    kinked,
    minimum,
    sign,
)
from jointplay.solver.quantities.units import Rule, quantity

STEEPEST_RAMP = 1e300
"""Slope (s/m) that stands for the step at equal limit velocities; finite, so 0 * slope is 0."""


class ModifiedCoulomb(FrictionLaw):
    """F_t = -c_f c_d F_n sgn(v_t), c_d = (|v_t| - v_0) / (v_1 - v_0) limited to 0..1.

    c_f is the friction coefficient, v_t the slip velocity (m/s), v_0 and v_1 the static and
    dynamic limit velocities (m/s); equal limits give a step.

    Assumes sliding contact. Fails to hold a static load: below v_0 there is no friction at all, so
    a loaded joint at rest creeps; the force has kinks at v_0 and v_1.

    Source: Ambrosio 2003, as printed in the press paper (Meccanica 2022), eqs 11-12.
    """

    law: Literal["modified-coulomb"] = "modified-coulomb"
    coefficient: Annotated[float, quantity("1", ge=0.0, le=10.0, structural=[0.0])]
    static_velocity: Annotated[float, quantity("m/s", ge=0.0, le=1e3)] = 1e-4
    dynamic_velocity: Annotated[float, quantity("m/s", gt=0.0, le=1e3)] = 1e-3
    slip_velocity: Annotated[
        Literal["material", "as-published"],
        Field(
            description=(
                "material: the relative velocity of the touching surfaces, body rotation included;"
                " as-published: the paper's eqs 5-7, which leave rotation out"
            )
        ),
    ] = "material"
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "static_velocity",
            lambda law: law.static_velocity > law.dynamic_velocity,
            lambda law: (
                f"The static limit velocity ({law.static_velocity:g} m/s) is above the dynamic one"
                f" ({law.dynamic_velocity:g} m/s); it may at most equal it."
            ),
        ),
    )

    def ramp_slope(self) -> Scalar:
        """Return 1 / (v_1 - v_0), s/m, bounded so that equal limit velocities are a step."""
        width = self.dynamic_velocity - self.static_velocity
        return minimum(1.0 / (width + 1.0 / STEEPEST_RAMP), STEEPEST_RAMP)

    def friction_force(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar] = ()
    ) -> Scalar:
        """Return F_t of eqs (11) and (12), N."""
        ramp = (absolute(slip) - self.static_velocity) * self.ramp_slope()
        direction = kinked(clamp_to_unit(ramp) * sign(slip), slip)
        return -(self.coefficient * direction * normal_force)

    @property
    def is_off(self) -> bool:
        """True if the coefficient is zero, and not data of a run."""
        return self.coefficient == 0.0

    @property
    def full_slip_speed(self) -> float:
        """v_1, m/s."""
        return self.dynamic_velocity

    @property
    def bends(self) -> tuple[float, float]:
        """v_1, and v_0 unless it is zero, m/s."""
        return self.dynamic_velocity, self.static_velocity or math.inf

    @property
    def slips_with_material(self) -> bool:
        """True where `slip_velocity` says so."""
        return self.slip_velocity == "material"

    @property
    def tangent_obstacle(self) -> str:
        """Equal limit velocities: the force jumps with the slip."""
        if self.is_off or self.dynamic_velocity > self.static_velocity:
            return ""
        return (
            "Friction jumps where its limit velocities are equal: a tangent has no derivative"
            " there. Choose a dynamic_velocity above the static_velocity."
        )
