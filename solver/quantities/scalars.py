"""The arithmetic that the mechanics are written in.

The same functions run on floats (the readable reference), on NumPy arrays (many instants at once)
and on traced expressions (`solver.kernels.trace.tracer`), which become kernels.
"""

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache, reduce
from typing import Any

import numpy as np

from jointplay.solver.quantities import elementary
from jointplay.solver.quantities.elementary import within_reach

type_of_array = np.ndarray

Scalar = Any
"""A float, a NumPy array or a traced expression."""

SLIGHT = 1e-300
"""Added to a length that may be zero, or its least value, so that it can divide."""

Scalars = Any
"""A sequence of scalars: a list, or an array of floats."""


def sqrt(x: Scalar) -> Scalar:
    """Square root."""
    if isinstance(x, float | int):
        return math.sqrt(x)
    return np.sqrt(x) if isinstance(x, type_of_array) else x.sqrt()


def sine_cosine(x: Scalar) -> tuple[Scalar, Scalar]:
    """Sine and cosine of an angle in rad."""
    if isinstance(x, float | int):
        return _sine_cosine_of(float(x) + 0.0)  # -0.0, which equals 0.0, must not find its sine
    if isinstance(x, type_of_array):
        return elementary.sine_cosine(within_reach(x))
    sine, cosine = x.sine_cosine()
    return sine, cosine


@lru_cache(maxsize=4096)  # joints of one body ask for its angle one after the other
def _sine_cosine_of(x: float) -> tuple[float, float]:
    sine, cosine = (x, x) if math.isnan(x) else elementary.sine_cosine(within_reach(x))
    return sine, cosine


def direction_angle(x: Scalar, y: Scalar) -> Scalar:
    """Return the angle of a direction against the x axis, rad, from -pi to pi.

    It is an eighth of the angle to the nearer half of that axis, by two halvings of its tangent,
    and the series of the arcus tangent up to the 19th power; the rest is 4e-16 of it.
    """
    reach = maximum(sqrt(x * x + y * y), absolute(y))  # squares may vanish
    tangent = y / (reach + absolute(x) + SLIGHT)
    for _ in range(2):
        tangent = tangent / (1.0 + sqrt(1.0 + tangent * tangent))
    square = tangent * tangent
    series: Scalar = 0.0
    for power_of_tangent in range(19, 0, -2):
        term = (1.0 if power_of_tangent % 4 == 1 else -1.0) / power_of_tangent
        series = series * square + term
    angle = 8.0 * (tangent * series)
    return select_positive(x, angle, -math.pi * sign(-y) - angle)  # pi where y is 0


def floor(x: Scalar) -> Scalar:
    """Return the largest whole number that is not above x."""
    if isinstance(x, float | int):
        return float(math.floor(x))
    return np.floor(x) if isinstance(x, type_of_array) else x.floor()


def select_positive(x: Scalar, if_positive: Scalar, otherwise: Scalar) -> Scalar:
    """`if_positive` where x > 0, else `otherwise` (also where x is NaN)."""
    if isinstance(x, float | int):
        return if_positive if x > 0.0 else otherwise
    if isinstance(x, type_of_array):
        return np.where(x > 0.0, if_positive, otherwise)
    return x.select_positive(if_positive, otherwise)


def positive_part(x: Scalar) -> Scalar:
    """Return the larger of x and 0."""
    return select_positive(x, x, 0.0)


def absolute(x: Scalar) -> Scalar:
    """Return the magnitude of x."""
    return abs(x)


def sign(x: Scalar) -> Scalar:
    """1 where x > 0, else -1."""
    return select_positive(x, 1.0, -1.0)


def minimum(x: Scalar, y: Scalar) -> Scalar:
    """Return the smaller of x and y."""
    return select_positive(x - y, y, x)


def maximum(x: Scalar, y: Scalar) -> Scalar:
    """Return the larger of x and y."""
    return select_positive(x - y, x, y)


def least(numbers: Iterable[Scalar]) -> Scalar:
    """Return the smallest of some numbers; infinity of none."""
    return reduce(minimum, numbers, math.inf)


def greatest(numbers: Iterable[Scalar], none: Scalar = 0.0) -> Scalar:
    """Return the largest of some numbers and `none`."""
    return reduce(maximum, numbers, none)


def exact_sum(numbers: Sequence[Scalar]) -> Scalar:
    """Return the sum of floats or arrays, rounded once."""
    if any(isinstance(number, type_of_array) for number in numbers):
        return np.array(
            [math.fsum(each) for each in zip(*np.broadcast_arrays(*numbers), strict=True)]
        )
    return math.fsum(numbers)


def clamp_to_unit(x: Scalar) -> Scalar:
    """Return x limited to 0..1."""
    return minimum(positive_part(x), 1.0)


def kinked(value: Scalar, argument: Scalar) -> Scalar:
    """Return `value`, a function of `argument` alone that is linear but for kinks and jumps.

    Traced expressions note it: a tangent vector that passes a kink within a step takes the mean
    slope over the step, for the slope at a few points of the step would miss where the kink is.
    """
    if isinstance(value, float | int | type_of_array):
        return value
    return value.kinked(argument)


def knotted(
    value: Scalar,
    argument: Scalar,
    knots: Sequence[Scalar],
    span: Scalar | None = None,
    *,
    jumps: bool = False,
) -> Scalar:
    """Return `value`, a function of `argument` alone that is smooth between its knots.

    Traced expressions note it, and steps end at knots. With a `span` the function repeats after
    it, and so do its knots. `jumps`: the value itself may jump there.
    """
    if isinstance(value, float | int | type_of_array):
        return value
    return value.knotted(argument, knots, span, jumps=jumps)


def power(x: Scalar, exponent: Scalar) -> Scalar:
    """Return x ** exponent for x >= 0; the Hertz exponent 1.5 costs one square root."""
    if isinstance(exponent, float) and exponent == 1.5:
        return x * sqrt(x)
    if isinstance(x, float | int):
        return elementary.power(float(x), exponent)
    if isinstance(x, type_of_array):
        return elementary.power(x, exponent)
    return x.power(exponent)


def logarithm(x: Scalar) -> Scalar:
    """Natural logarithm of x > 0. Zero and below: ValueError, and NaN in an array."""
    if isinstance(x, float | int):
        if x <= 0.0:
            raise ValueError("math domain error")
        return elementary.log(float(x))
    if isinstance(x, type_of_array):
        return elementary.log(np.where(x > 0.0, x, math.nan))
    return x.logarithm()


def exponential(x: Scalar) -> Scalar:
    """Return e ** x, for x below 700."""
    if isinstance(x, float | int):
        return elementary.exp(float(x))
    return elementary.exp(x) if isinstance(x, type_of_array) else x.exponential()


def hyperbolic_tangent(x: Scalar) -> Scalar:
    """Hyperbolic tangent, within a few units in the last place of 1."""
    decay = exponential(-2.0 * absolute(x))
    return sign(x) * ((1.0 - decay) / (1.0 + decay))
