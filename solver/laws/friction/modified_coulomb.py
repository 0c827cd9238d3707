"""Modified Coulomb friction: the paper's eqs 11-12."""

from types import SimpleNamespace
from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.quantities.scalars import (
    Scalar,
    absolute,
    clamp_to_unit,
    kinked,
    minimum,
    sign,
)
from jointplay.solver.quantities.units import Strict

STEEPEST_RAMP = 1e300
"""Slope (s/m) that stands for the step at equal limit velocities; finite, so 0 * slope is 0."""


class ModifiedCoulomb(Strict):
    """F_t = -c_f c_d F_n sgn(v_t), c_d = (|v_t| - v_0) / (v_1 - v_0) limited to 0..1.

    c_f is the friction coefficient, v_t the slip velocity (m/s), v_0 and v_1 the static and
    dynamic limit velocities (m/s); equal limits give a step.

    Assumes sliding contact. Fails to hold a static load: below v_0 there is no friction at all, so
    a loaded joint at rest creeps; the force has kinks at v_0 and v_1.

    Source: Ambrosio 2003, as printed in the press paper (Meccanica 2022), eqs 11-12.
    """

    law: Literal["modified-coulomb"] = "modified-coulomb"
    coefficient: Annotated[
        float, Field(ge=0.0, le=10.0, json_schema_extra={"unit": "1", "structural": [0.0]})
    ]
    static_velocity: Annotated[float, Field(ge=0.0, le=1e3, json_schema_extra={"unit": "m/s"})] = (
        1e-4
    )
    dynamic_velocity: Annotated[float, Field(gt=0.0, le=1e3, json_schema_extra={"unit": "m/s"})] = (
        1e-3
    )
    slip_velocity: Annotated[
        Literal["material", "as-published"],
        Field(
            description=(
                "material: the relative velocity of the touching surfaces, body rotation included;"
                " as-published: the paper's eqs 5-7, which leave rotation out"
            )
        ),
    ] = "material"

    @property
    def jumps(self) -> bool:
        """Whether the force jumps with the slip: then no tangent vector follows a held joint."""
        return self.coefficient > 0.0 and self.dynamic_velocity <= self.static_velocity


def ramp_slope(law: SimpleNamespace) -> Scalar:
    """1 / (v_1 - v_0), s/m, bounded so that equal limit velocities are a step."""
    width = law.dynamic_velocity - law.static_velocity
    return minimum(1.0 / (width + 1.0 / STEEPEST_RAMP), STEEPEST_RAMP)


def friction_force(law: SimpleNamespace, normal_force: Scalar, slip: Scalar) -> Scalar:
    """Return F_t on the journal along t, N; it opposes the slip velocity (m/s)."""
    ramp = (absolute(slip) - law.static_velocity) * ramp_slope(law)
    direction = kinked(clamp_to_unit(ramp) * sign(slip), slip)
    return -(law.coefficient * direction * normal_force)  # eqs (11), (12)
