"""Natural logarithm in loops: that of a C library has other bits on another processor."""

import math

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.quantities.elementary import ATANH_SERIES, LN_2

LEAST = math.sqrt(0.5)
"""Mantissas are from here to twice as much, about 1."""


@inner_kernel()
def logarithm(x: float) -> float:
    """Return the natural logarithm of a finite x > 0, within 4e-16 of max(1, |log x|)."""
    mantissa, exponent = math.frexp(x)
    if mantissa < LEAST:
        mantissa, exponent = 2.0 * mantissa, exponent - 1
    f = (mantissa - 1.0) / (mantissa + 1.0)
    square, series = f * f, 0.0
    for k in range(len(ATANH_SERIES) - 1, -1, -1):
        series = series * square + ATANH_SERIES[k]
    return exponent * LN_2 + 2.0 * f * series
