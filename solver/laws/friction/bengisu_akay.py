"""Bengisu and Akay's friction: a parabola up to the static force, an exponential down from it."""

from collections.abc import Sequence
from typing import Annotated, Literal

from jointplay.solver.laws.friction.breakaway import Breakaway, SlipSpeed
from jointplay.solver.quantities.scalars import (
    Scalar,
    absolute,
    exponential,
    maximum,
    minimum,
    sign,
)
from jointplay.solver.quantities.units import quantity


class BengisuAkay(Breakaway):
    """F_t = -c F_n sgn v_t, c a parabola and then an exponential of the slip velocity.

    c = c_s (1 - (1 - |v_t| / v_0)²) up to v_0, c = c_k + (c_s - c_k) exp(-ξ (|v_t| - v_0)) beyond;
    c_s and c_k are the static and the kinetic coefficient, v_t the slip velocity, v_0 the slip of
    the largest force (m/s), ξ the decay of the static force with slip.

    Assumes sliding contact, with a force that falls with speed: it may excite stick-slip. Fails to
    hold a static load: a loaded joint at rest creeps; the slope of the force jumps at v_0.

    Source: Bengisu and Akay 1994, J. Sound Vib. 171:557.
    """

    law: Literal["bengisu-akay"] = "bengisu-akay"
    static_velocity: SlipSpeed = 1e-3
    decay: Annotated[float, quantity("s/m", ge=0.0, le=1e6)] = 100.0

    def friction_force(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar] = ()
    ) -> Scalar:
        """Return F_t, N."""
        speed = absolute(slip)
        missing = 1.0 - minimum(speed / self.static_velocity, 1.0)
        beyond = maximum(speed - self.static_velocity, 0.0)
        falling = self.surplus * (1.0 - exponential(-(self.decay * beyond)))
        coefficient = self.static_coefficient * (1.0 - missing * missing) - falling
        return -(coefficient * sign(slip) * normal_force)

    @property
    def full_slip_speed(self) -> float:
        """v_0, m/s."""
        return self.static_velocity
