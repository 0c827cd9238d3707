"""LuGre friction: damped bristles with Stribeck's effect."""

from collections.abc import Sequence
from typing import Annotated, Literal

from jointplay.solver.laws.friction.breakaway import Breakaway, SlipSpeed
from jointplay.solver.laws.friction.dahl import BristleStiffness
from jointplay.solver.laws.friction.law import InnerState
from jointplay.solver.quantities.scalars import Scalar, absolute, exponential
from jointplay.solver.quantities.units import quantity

Damping = Annotated[float, quantity("s/m", ge=0.0, le=1e6)]


class LuGre(Breakaway):
    """F_t = -(σ_0 z + σ_1 z' + σ_2 v_t) F_n, z' = v_t - σ_0 |v_t| z / g.

    g = c_k + (c_s - c_k) exp(-(v_t / v_s)²); z is the deflection of the bristles (m), σ_0 their
    stiffness, σ_1 their damping and σ_2 the viscous friction, each by the normal force; c_s and c_k
    are the static and the kinetic coefficient, v_t the slip and v_s the Stribeck velocity (m/s).

    Assumes bristles that bend with the slip while apart, too. Fails under a load that swings: z
    drifts. Large σ_1 may give energy at high speed. Stiff where σ_0 |v_t| / g is far above the
    rates of the mechanism: then `auto` goes over to `rodas`.

    Source: Canudas de Wit, Olsson, Astroem and Lischinsky 1995, IEEE Trans. Autom. Control 40:419;
    scaled with the normal force as by Canudas de Wit and Tsiotras 1999, eqs 7-8.
    """

    law: Literal["lugre"] = "lugre"
    stribeck_velocity: SlipSpeed = 1e-2
    bristle_stiffness: BristleStiffness
    bristle_damping: Damping = 0.0
    viscous_damping: Damping = 0.0

    @property
    def inner_states(self) -> tuple[InnerState, ...]:
        """The bristles."""
        scale = self.static_coefficient / self.bristle_stiffness
        return (InnerState("bristle", "m", "deflection of the bristles", scale),)

    def friction_force(self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]) -> Scalar:
        """Return F_t, N."""
        (rate,) = self.inner_rates(normal_force, slip, inner)
        damped = self.bristle_damping * rate + self.viscous_damping * slip
        return -((self.bristle_stiffness * inner[0] + damped) * normal_force)

    def inner_rates(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
    ) -> Sequence[Scalar]:
        """Return z', m/s."""
        ratio = slip / self.stribeck_velocity
        full = self.kinetic_coefficient + self.surplus * exponential(-(ratio * ratio))
        return (slip - absolute(slip) * (self.bristle_stiffness * inner[0] / full),)

    @property
    def full_slip_speed(self) -> float:
        """v_s, m/s."""
        return self.stribeck_velocity

    @property
    def bends(self) -> tuple[float, float]:
        """v_s, m/s, and rest: where the slip turns round, the bristles' rate bends."""
        return self.stribeck_velocity, 0.0
