"""Quantiles of the standard normal distribution, and shares below a value, as own arithmetic."""

import math
from functools import reduce

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.elementary import log

_CENTRE = (
    (2509.0809287301226727, 33430.575583588128105, 67265.770927008700853, 45921.953931549871457)
    + (13731.693765509461125, 1971.5909503065514427, 133.14166789178437745, 3.387132872796366608),
    (5226.495278852854561, 28729.085735721942674, 39307.89580009271061, 21213.794301586595867)
    + (5394.1960214247511077, 687.1870074920579083, 42.313330701600911252, 1.0),
)
_NEAR = (
    (7.7454501427834140764e-4, 0.0227238449892691845833, 0.24178072517745061177)
    + (1.27045825245236838258, 3.64784832476320460504, 5.7694972214606914055)
    + (4.6303378461565452959, 1.42343711074968357734),
    (1.05075007164441684324e-9, 5.475938084995344946e-4, 0.0151986665636164571966)
    + (0.14810397642748007459, 0.68976733498510000455, 1.6763848301838038494)
    + (2.05319162663775882187, 1.0),
)
_FAR = (
    (2.01033439929228813265e-7, 2.71155556874348757815e-5, 0.0012426609473880784386)
    + (0.026532189526576123093, 0.29656057182850489123, 1.7848265399172913358)
    + (5.4637849111641143699, 6.6579046435011037772),
    (2.04426310338993978564e-15, 1.4215117583164458887e-7, 1.8463183175100546818e-5)
    + (7.868691311456132591e-4, 0.0148753612908506148525, 0.13692988092273580531)
    + (0.59983220655588793769, 1.0),
)
_LEAST = 1e-300
_HALVINGS = 70


def quantiles(shares: Floats) -> Floats:
    """Return the values below which lie shares above 0 and below 1, to about sixteen digits.

    Source: Wichura 1988, Algorithm AS 241, Applied Statistics 37:477, PPND16.
    """
    about = shares - 0.5
    inner = 0.180625 - about * about
    tail = np.sqrt(-log(np.clip(np.minimum(shares, 1.0 - shares), _LEAST, 0.5)))
    outer = np.where(tail <= 5.0, _ratio(_NEAR, tail - 1.6), _ratio(_FAR, tail - 5.0))
    found = np.where(np.abs(about) <= 0.425, about * _ratio(_CENTRE, inner), outer)
    return np.where((np.abs(about) > 0.425) & (about < 0.0), -outer, found)


def share_below(value: float) -> float:
    """Return the share below a value, as the one whose quantile it is."""
    if value > 0.0:
        return 1.0 - share_below(-value)
    low, high = _LEAST, 0.5
    for _ in range(_HALVINGS):
        middle = math.sqrt(low) * math.sqrt(high)
        if quantiles(np.array([middle]))[0] < value:
            low = middle
        else:
            high = middle
    return high


def _ratio(polynomials: tuple[tuple[float, ...], tuple[float, ...]], x: Floats) -> Floats:
    above, below = (
        reduce(lambda sum_, c: sum_ * x + c, coefficients, np.zeros_like(x))
        for coefficients in polynomials
    )
    return above / below
