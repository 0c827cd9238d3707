"""A sine."""

import math
from typing import Annotated, Literal

from jointplay.solver.laws.function.law import SMOOTH, Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar, sine_cosine
from jointplay.solver.quantities.units import quantity

Value = Annotated[float, quantity("unit of the value", ge=-1e12, le=1e12)]


class Sinusoidal(Function):
    """f(x) = offset + amplitude sin(frequency x + phase).

    The frequency is an angular one: 2 pi over the period, rad per unit of x, so over time in rad/s,
    and over an angle the number of waves in a turn.

    Assumes one harmonic. Fails nowhere.

    Source: the definition of a harmonic.
    """

    type: Literal["sinusoidal"]
    amplitude: Value
    frequency: Annotated[
        float,
        quantity(
            "rad per unit of x",
            ge=1e-9,
            le=1e9,
            description="angular frequency, 2 pi over the period: not cycles",
        ),
    ]
    phase: Annotated[float, quantity("rad", ge=-1e4, le=1e4)] = 0.0
    offset: Value = 0.0

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives."""
        sine, cosine = sine_cosine(self.frequency * x + self.phase)
        slope = self.amplitude * self.frequency
        return Derivatives(
            self.amplitude * sine + self.offset, slope * cosine, -(slope * self.frequency * sine)
        )

    @property
    def period(self) -> float:
        """2 pi / frequency, whatever the amplitude is."""
        return 2.0 * math.pi / self.frequency

    @property
    def is_constant(self) -> bool:
        """Whether the amplitude is zero."""
        return self.amplitude == 0.0

    @property
    def bend(self) -> float:
        """The period."""
        return self.period

    def largest(self, until: float) -> list[float]:
        """Return amplitude times powers of the frequency."""
        return [abs(self.amplitude) * math.prod([self.frequency] * k) for k in range(1, SMOOTH + 1)]
