"""Interface of functions of one argument: prescribed motions, forces that vary."""

import math
from abc import abstractmethod
from typing import ClassVar, Literal, NamedTuple, Self

from jointplay.solver.quantities.scalars import Scalar, power
from jointplay.solver.quantities.units import Rule, Strict

SMOOTH = 6
"""Derivatives that bounds on a path within a step look at; see `kernels.emit.enclosure`."""


Between = Literal["smooth", "monotone"]
"""Course between knots: with a continuous second derivative, or between neighbouring values."""


class Derivatives(NamedTuple):
    """A function's value, first and second derivative at one argument."""

    value: Scalar
    slope: Scalar
    curvature: Scalar


class Function(Strict):
    """A function of one number, whose unit and meaning are given where it stands."""

    type: str
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""

    @abstractmethod
    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives at an argument; arithmetic on abstract scalars."""

    @property
    @abstractmethod
    def period(self) -> float:
        """Length of the argument after which it repeats: 0 if constant, infinite if it never does.

        In the argument's unit. A harmonic has one also where its amplitude is zero, so that a study
        of amplitudes from zero on has one unit of time; see `is_constant`.
        """

    @property
    def is_constant(self) -> bool:
        """Whether it has one value everywhere."""
        return self.period == 0.0

    @property
    def domain(self) -> tuple[float, float] | None:
        """First and last argument, if others are refused: there the value is not a number."""
        return None

    @property
    def bend(self) -> float:
        """Length of the argument in which it bends, as a period would be; infinite: none."""
        return math.inf

    @property
    def has_curvature(self) -> bool:
        """True if the second derivative is bounded, and exists but at single arguments."""
        return True

    @abstractmethod
    def largest(self, until: float) -> list[float]:
        """Return bounds on the magnitudes of the first derivatives, over arguments 0..`until`.

        At most `SMOOTH` of them, in order; those left out are zero.
        """

    def speed_within(self, _way: Scalar) -> Scalar:
        """Return the largest slope, magnitude, while it moves from 0 on by about a way, positive.

        Of a function whose slope has a bound everywhere, that bound.
        """
        return next(iter(self.largest(0.0)), 0.0)

    def overshoot(self) -> tuple[float, float]:
        """Return how far f passes given values between two of them, and the argument there.

        As a share of the range of all of them; 0 where none are given, or none is passed.
        """
        return 0.0, math.nan

    def used(self, between: Between) -> Self:
        """Return the function with what its use makes of it where it is not said."""
        return self

    def quickness(self, until: float, unit: float) -> float:
        """Return the least r with |f^(k)| <= unit r^k for each of these derivatives, k from 1."""
        bounds = enumerate(self.largest(until), start=1)
        return max((power(bound / unit, 1.0 / k) for k, bound in bounds), default=0.0)
