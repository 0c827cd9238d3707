"""A start-up to constant speed: the integral of a smooth step."""

import math
from typing import Annotated, Literal

from jointplay.solver.laws.function.law import Derivatives, Function
from jointplay.solver.laws.function.ramp import STEEPEST, Length, step
from jointplay.solver.quantities.scalars import Scalar, clamp_to_unit, knotted, positive_part
from jointplay.solver.quantities.units import quantity

Rate = Annotated[float, quantity("unit of the value per unit of x", ge=-1e9, le=1e9)]


class StartUp(Function):
    """f' = start_speed + (speed - start_speed) (10 u³ - 15 u⁴ + 6 u⁵), u = x / length in 0..1.

    f(0) = 0. Behind the ramp f goes on at constant speed; its first three derivatives are
    continuous.

    Assumes a drive that reaches its speed whatever it carries. Fails before x = 0, where it goes
    on at its first speed.

    Source: the integral of `ramp`.
    """

    type: Literal["start-up"]
    start_speed: Rate = 0.0
    speed: Rate
    length: Length

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives."""
        share = x / self.length
        u = clamp_to_unit(share)
        rise, left = self.speed - self.start_speed, 1.0 - u
        area = (u * u) * (u * u) * (2.5 - u * (3.0 - u)) + positive_part(share - 1.0)
        parts = (
            self.start_speed * x + rise * self.length * area,
            self.start_speed + rise * step(u),
            (30.0 * rise / self.length) * (u * u * left * left),
        )
        return Derivatives(*(knotted(part, x, (0.0, self.length)) for part in parts))

    @property
    def period(self) -> float:
        """Infinite, unless nothing moves."""
        return math.inf if self.start_speed != 0.0 or self.speed != 0.0 else 0.0

    @property
    def bend(self) -> float:
        """The ramp's length."""
        return self.length

    def largest(self, until: float) -> list[float]:
        """Return the larger speed, and what the step's derivatives are at most."""
        rise = abs(self.speed - self.start_speed)
        further = [
            rise * bound / math.prod([self.length] * k) for k, bound in enumerate(STEEPEST, start=1)
        ]
        return [max(abs(self.speed), abs(self.start_speed)), *further]
