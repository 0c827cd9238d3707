"""A polynomial."""

import math
from typing import Annotated, Literal

from numpy.polynomial import Polynomial as Numeric
from pydantic import Field

from jointplay.solver.laws.function.law import SMOOTH, Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar, greatest, maximum, power
from jointplay.solver.quantities.units import quantity

Coefficient = Annotated[float, quantity("unit of the value per unit^k of x", ge=-1e12, le=1e12)]


class Polynomial(Function):
    """f(x) = c_0 + c_1 x + c_2 x² + ..., at most of degree 9.

    The coefficients are in rising order.

    Assumes that arguments stay where it was fitted. Fails far from there, where the highest power
    grows without end.

    Source: the definition of a polynomial.
    """

    type: Literal["polynomial"]
    coefficients: Annotated[list[Coefficient], Field(min_length=1, max_length=10)]

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives by Horner's rule."""
        return derivatives(self.coefficients, x)

    @property
    def period(self) -> float:
        """Infinite, unless the polynomial is a constant."""
        return math.inf if any(self.coefficients[1:]) else 0.0

    def largest(self, until: float) -> list[float]:
        """Return the largest magnitudes, at the ends or where the next derivative vanishes."""
        return largest_magnitudes(Numeric(self.coefficients), until)

    def speed_within(self, way: Scalar) -> Scalar:
        """Return the largest slope at which one power alone has moved by that way."""
        slopes: list[Scalar] = []
        for k, coefficient in enumerate(self.coefficients[1:], start=1):
            size = maximum(coefficient, -coefficient)
            slopes.append(k * power(size / way, 1.0 / k) * way)  # k c x^(k-1), with c x^k the way
        return greatest(slopes)


def derivatives(coefficients: list[Scalar], x: Scalar) -> Derivatives:
    """Return value and derivatives of a polynomial, lowest power first."""
    first = [k * c for k, c in enumerate(coefficients)][1:]
    second = [k * c for k, c in enumerate(first)][1:]
    return Derivatives(*(_horner(part, x) for part in (coefficients, first, second)))


def largest_magnitudes(polynomial: Numeric, until: float) -> list[float]:
    """Return the largest magnitudes of its first derivatives over arguments 0..`until`."""
    found = []
    derivative = polynomial
    for _ in range(min(SMOOTH, len(polynomial.coef) - 1)):
        derivative = derivative.deriv()
        turns = derivative.deriv().roots().real
        places = [0.0, until, *(x for x in turns if 0.0 < x < until)]
        found.append(max(abs(float(derivative(x))) for x in places))
    return found


def _horner(coefficients: list[Scalar], x: Scalar) -> Scalar:
    total: Scalar = 0.0
    for c in reversed(coefficients):
        total = total * x + c
    return total
