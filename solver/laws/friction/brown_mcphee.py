"""Brown and McPhee's friction: a smooth Stribeck curve of one velocity."""

from collections.abc import Sequence
from typing import Literal

from jointplay.solver.laws.friction.breakaway import Breakaway, SlipSpeed
from jointplay.solver.quantities.scalars import Scalar, hyperbolic_tangent


class BrownMcPhee(Breakaway):
    """F_t = -(c_k tanh(4 w) + (c_s - c_k) w / (w² / 4 + 3/4)²) F_n, w = v_t / v_r.

    c_s and c_k are the static and the kinetic coefficient, v_t the slip velocity, v_r that of the
    largest force (m/s).

    Assumes sliding contact; every derivative of the force is continuous. Fails to hold a static
    load: a loaded joint at rest creeps. Viscous friction is left out.

    Source: Brown and McPhee 2016, J. Comput. Nonlinear Dyn. 11:054502.
    """

    law: Literal["brown-mcphee"] = "brown-mcphee"
    transition_velocity: SlipSpeed = 1e-3

    def friction_force(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar] = ()
    ) -> Scalar:
        """Return F_t, N."""
        ratio = slip / self.transition_velocity
        width = 0.25 * ratio * ratio + 0.75
        sliding = self.kinetic_coefficient * hyperbolic_tangent(4.0 * ratio)
        return -((sliding + self.surplus * (ratio / (width * width))) * normal_force)

    @property
    def full_slip_speed(self) -> float:
        """v_r, m/s."""
        return self.transition_velocity
