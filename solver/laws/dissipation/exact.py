"""The damping that delivers the restitution asked, exactly."""

from typing import Literal

from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.dissipation.law import SomeRestitution
from jointplay.solver.quantities.scalars import Scalar, exponential, maximum, select_positive

SERIES = 0.03
"""Loss below which the inverse is a series: the next term is 1e-12 of it."""
ROUNDS = 5


def inverse_langevin(y: Scalar) -> Scalar:
    """Return x with coth x - 1 / x = y, for y from 0 to 0.999."""
    square = y * y
    near = y * (3.0 + square * (9.0 / 5.0 + square * (297.0 / 175.0 + square * 1539.0 / 875.0)))
    far = maximum(y, SERIES)
    x = far * (3.0 - far * far) / (1.0 - far * far)  # Cohen 1991: to 5 %
    for _ in range(ROUNDS):
        decay = exponential(-2.0 * x)
        less = 1.0 - decay
        value = (1.0 + decay) / less - 1.0 / x
        x = x - (value - far) / (1.0 / (x * x) - 4.0 * decay / (less * less))
    return select_positive(y - SERIES, x, near)


class Exact(Latched):
    """χ = 2 x / (1 + e), coth x - 1 / x = (1 - e) / (1 + e).

    e is the restitution coefficient asked; F_n = F_e (1 + χ δ̇ / δ̇⁻). It is the solution of the
    integral of energy, χ (1 + e) = ln((1 + χ) / (1 - χ e)), with A = 1 + χ, B = 1 - χ e and
    2 x = ln(A / B): A - B = 2 x makes A = x (coth x + 1) and B = x (coth x - 1).

    Assumes a free impact, whose restitution it delivers at any speed above its floor, mass and
    stiffness. Fails in lasting contact, where the rate latched at the last onset scales the
    damping.

    Source: the integral of energy above; Zhang and Sharf 2009, J. Appl. Mech. 76, solve the same
    equation.
    """

    law: Literal["exact"] = "exact"
    restitution: SomeRestitution

    def hysteresis(self) -> Scalar:
        """Return χ, 1."""
        whole = 1.0 + self.restitution
        return 2.0 * inverse_langevin((1.0 - self.restitution) / whole) / whole
