"""Threlfall's friction: an exponential between rest and sliding."""

from collections.abc import Sequence
from typing import Literal

from jointplay.solver.laws.friction.breakaway import Coefficient, SlipSpeed
from jointplay.solver.laws.friction.law import FrictionLaw
from jointplay.solver.quantities.scalars import Scalar, absolute, exponential, minimum, sign


class Threlfall(FrictionLaw):
    """F_t = -c_f F_n (1 - exp(-3 |v_t| / v_r)) sgn v_t, constant beyond |v_t| = v_r.

    c_f is the friction coefficient, v_t the slip velocity, v_r the slip at which friction is full
    (m/s): 1 - exp(-3) = 0.9502 of c_f F_n, for which the source writes 0.95, with a small jump.

    Assumes sliding contact. Fails to hold a static load: a loaded joint at rest creeps; the slope
    of the force jumps at v_r, by a twentieth of that at rest.

    Source: Threlfall 1978, Mech. Mach. Theory 13:475.
    """

    law: Literal["threlfall"] = "threlfall"
    coefficient: Coefficient
    full_velocity: SlipSpeed = 1e-3

    def friction_force(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar] = ()
    ) -> Scalar:
        """Return F_t, N."""
        share = minimum(absolute(slip) / self.full_velocity, 1.0)
        return -(self.coefficient * (1.0 - exponential(-3.0 * share)) * sign(slip) * normal_force)

    @property
    def full_slip_speed(self) -> float:
        """v_r, m/s."""
        return self.full_velocity
