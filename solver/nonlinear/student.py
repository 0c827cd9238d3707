"""Student's t at three errors: how far means of few numbers may be off by chance.

The distribution for a whole number of degrees of freedom is a finite sum, and its quantile for many
of them an expansion about the normal one (Abramowitz and Stegun 1972, 26.7.3, 26.7.4 and 26.7.5).
"""

import math
from functools import cache

from jointplay.solver.nonlinear.estimate import SIGNIFICANT
from jointplay.solver.quantities.scalars import direction_angle

WITHIN = 0.9973002039367398
"""Share of normal numbers that lie within three standard deviations."""
FEW = 200
"""Degrees of freedom up to which the sum is taken; beyond, the expansion errs by 4e-11."""


@cache
def student(freedom: int) -> float:
    """Return t within which as many lie as within three standard deviations of normal numbers."""
    z, n = SIGNIFICANT, float(freedom)
    if freedom > FEW:
        s = z * z
        first = z * (s + 1.0) / 4.0
        second = z * ((5.0 * s + 16.0) * s + 3.0) / 96.0
        third = z * (((3.0 * s + 19.0) * s + 17.0) * s - 15.0) / 384.0
        fourth = z * ((((79.0 * s + 776.0) * s + 1482.0) * s - 1920.0) * s - 945.0) / 92160.0
        return z + (first + (second + (third + fourth / n) / n) / n) / n
    low, high = z, 300.0
    while (middle := 0.5 * (low + high)) not in (low, high):
        low, high = (middle, high) if _share_within(middle, freedom) < WITHIN else (low, middle)
    return high


def _share_within(t: float, freedom: int) -> float:
    """Return how many of Student's numbers have a magnitude of at most t."""
    root = math.sqrt(freedom + t * t)
    sine, square = t / root, freedom / (freedom + t * t)
    odd = freedom % 2
    total, term = 0.0, 1.0
    for k in range(odd, (freedom + odd) // 2):
        total += term
        term *= square * ((2.0 * k) / (2.0 * k + 1.0) if odd else (2.0 * k + 1.0) / (2.0 * k + 2.0))
    if not odd:
        return sine * total
    cosine = math.sqrt(square)
    angle = float(direction_angle(math.sqrt(freedom), t))
    return (angle + sine * cosine * total) * (2.0 / math.pi)
