"""Natural logarithm in loops: that of a C library has other bits on another processor."""

import math

from jointplay.solver.kernels.jit import inner_kernel

LN_2 = 0.6931471805599453
ATANH_SERIES = tuple(1.0 / (2 * k + 1) for k in range(11))
"""As in `solver.quantities.elementary`; compiled code takes nothing from outside of this package,
for changes there would not compile it anew."""
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
