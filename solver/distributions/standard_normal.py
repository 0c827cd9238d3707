"""Quantiles of the standard normal distribution, and shares below a value, as own arithmetic."""

import math
from functools import reduce

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.elementary import log

_CENTRE = (
    (
        *(2509.0809287301227, 33430.57558358813, 67265.7709270087, 45921.95393154987),
        *(13731.69376550946, 1971.5909503065513, 133.14166789178438, 3.3871328727963665),
    ),
    (
        *(5226.495278852854, 28729.085735721943, 39307.89580009271, 21213.794301586597),
        *(5394.196021424751, 687.1870074920579, 42.31333070160091, 1.0),
    ),
)
_NEAR = (
    (
        *(0.0007745450142783414, 0.022723844989269184, 0.2417807251774506, 1.2704582524523684),
        *(3.6478483247632045, 5.769497221460691, 4.630337846156546, 1.4234371107496835),
    ),
    (
        *(1.0507500716444169e-09, 0.0005475938084995345, 0.015198666563616457, 0.14810397642748008),
        *(0.6897673349851, 1.6763848301838038, 2.053191626637759, 1.0),
    ),
)
_FAR = (
    (
        *(
            2.0103343992922881e-07,
            2.7115555687434876e-05,
            0.0012426609473880784,
            0.026532189526576124,
        ),
        *(0.29656057182850487, 1.7848265399172913, 5.463784911164114, 6.657904643501103),
    ),
    (
        *(
            2.0442631033899397e-15,
            1.421511758316446e-07,
            1.8463183175100548e-05,
            0.0007868691311456133,
        ),
        *(0.014875361290850615, 0.1369298809227358, 0.599832206555888, 1.0),
    ),
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
