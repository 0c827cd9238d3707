"""A smooth step."""

import math
from typing import Annotated, Literal

from jointplay.solver.laws.function.law import Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar, clamp_to_unit, knotted
from jointplay.solver.quantities.units import quantity

Value = Annotated[float, quantity("unit of the value", ge=-1e12, le=1e12)]
Length = Annotated[float, quantity("unit of x", ge=1e-9, le=1e9)]
STEEPEST = (1.875, 10.0 / math.sqrt(3.0), 60.0, 360.0, 720.0)
"""Largest magnitudes of the derivatives of 10 u³ - 15 u⁴ + 6 u⁵ on 0..1, the first at u = 1/2."""


class Ramp(Function):
    """f(x) = start + (end - start) (10 u³ - 15 u⁴ + 6 u⁵), u = x / length held within 0 and 1.

    Slope and curvature are continuous, and vanish outside.

    Assumes a step from rest to rest, at x = 0. Fails nowhere; its third derivative jumps at both
    ends.

    Source: the polynomial of degree 5 whose first two derivatives vanish at both ends (3-4-5 of
    cams); Norton 2009, Cam Design and Manufacturing Handbook.
    """

    type: Literal["ramp"]
    start: Value = 0.0
    end: Value
    length: Length

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives."""
        u = clamp_to_unit(x / self.length)
        rise, left = self.end - self.start, 1.0 - u
        parts = (
            self.start + rise * step(u),
            (30.0 * rise / self.length) * (u * u * left * left),
            (60.0 * rise / (self.length * self.length)) * (u * left * (left - u)),
        )
        return Derivatives(*(knotted(part, x, (0.0, self.length)) for part in parts))

    @property
    def period(self) -> float:
        """Infinite, unless it ends where it starts."""
        return math.inf if self.end != self.start else 0.0

    @property
    def bend(self) -> float:
        """The length of the step."""
        return self.length

    def largest(self, until: float) -> list[float]:
        """Return what the step's derivatives are at most."""
        rise = abs(self.end - self.start)
        return [
            rise * bound / math.prod([self.length] * k) for k, bound in enumerate(STEEPEST, start=1)
        ]


def step(u: Scalar) -> Scalar:
    """Return 10 u³ - 15 u⁴ + 6 u⁵."""
    return u * u * u * (10.0 - u * (15.0 - 6.0 * u))
