"""Dahl's friction: bristles that bend until they slide."""

from collections.abc import Sequence
from typing import Annotated, Literal

from jointplay.solver.laws.friction.breakaway import Coefficient
from jointplay.solver.laws.friction.law import FrictionLaw, InnerState
from jointplay.solver.quantities.scalars import Scalar, absolute
from jointplay.solver.quantities.units import quantity

BristleStiffness = Annotated[
    float, quantity("1/m", gt=0.0, le=1e9, description="σ_0, a normal force")
]


class Dahl(FrictionLaw):
    """F_t = -σ_0 z F_n, z' = v_t - σ_0 |v_t| z / c_f.

    z is the deflection of the bristles (m), σ_0 their stiffness by the normal force, c_f the
    friction coefficient, v_t the slip velocity (m/s).

    Assumes bristles that bend with the slip while apart, too. Fails to tell sticking from sliding:
    there is no static force above the kinetic one; under a load that swings, z drifts. Stiff where
    σ_0 |v_t| / c_f is far above the rates of the mechanism: then `auto` goes over to `rodas`.

    Source: Dahl 1968, The Aerospace Corporation TOR-0158(3107-18), scaled with the normal force as
    by Canudas de Wit and Tsiotras 1999, eqs 7-8.
    """

    law: Literal["dahl"] = "dahl"
    coefficient: Coefficient
    bristle_stiffness: BristleStiffness

    @property
    def inner_states(self) -> tuple[InnerState, ...]:
        """The bristles."""
        scale = self.coefficient / self.bristle_stiffness
        return (InnerState("bristle", "m", "deflection of the bristles", scale),)

    def friction_force(self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]) -> Scalar:
        """Return F_t, N."""
        return -(self.bristle_stiffness * inner[0] * normal_force)

    def inner_rates(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
    ) -> Sequence[Scalar]:
        """Return z', m/s."""
        bent = self.bristle_stiffness * inner[0] / self.coefficient
        return (slip - absolute(slip) * bent,)
