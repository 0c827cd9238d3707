"""Stribeck's curve, its jump at rest made steep by a hyperbolic tangent."""

from collections.abc import Sequence
from typing import Literal

from jointplay.solver.laws.friction.breakaway import Breakaway, SlipSpeed
from jointplay.solver.quantities.scalars import Scalar, exponential, hyperbolic_tangent


class Stribeck(Breakaway):
    """F_t = -(c_k + (c_s - c_k) exp(-(v_t / v_s)²)) tanh(v_t / v_r) F_n.

    c_s and c_k are the static and the kinetic coefficient, v_t the slip velocity, v_s the Stribeck
    velocity, v_r the velocity that smooths the jump at rest (m/s), better far below v_s.

    Assumes sliding contact, with a force that falls with speed: it may excite stick-slip. Fails to
    reach the static force: with c_k two thirds of c_s, 0.968 of it where v_r is a tenth of v_s, and
    0.999 where it is a hundredth. It holds no static load, a loaded joint at rest creeps. Viscous
    friction, which does not end with the normal force, is left out.

    Source: Andersson, Soederberg and Bjoerklund 2007, Tribol. Int. 40:580, with the exponent 2.
    """

    law: Literal["stribeck"] = "stribeck"
    stribeck_velocity: SlipSpeed = 1e-2
    smoothing_velocity: SlipSpeed = 1e-3

    def friction_force(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar] = ()
    ) -> Scalar:
        """Return F_t, N."""
        ratio = slip / self.stribeck_velocity
        coefficient = self.kinetic_coefficient + self.surplus * exponential(-(ratio * ratio))
        return -(coefficient * hyperbolic_tangent(slip / self.smoothing_velocity) * normal_force)

    @property
    def full_slip_speed(self) -> float:
        """v_r, m/s."""
        return self.smoothing_velocity

    @property
    def bends(self) -> tuple[float, float]:
        """v_r and v_s, m/s."""
        return self.smoothing_velocity, self.stribeck_velocity
