"""Numbers in equal ratios, each the nearest float, so of the same bits on every processor.

Decades between decimal ends are decades: 1e-4 to 1e-2 in three is 1e-4, 1e-3, 1e-2.
"""

import math
from collections.abc import Sequence
from decimal import Decimal, localcontext

import numpy as np

from jointplay.records.arrays import Floats

DIGITS = 40
"""Digits of the logarithms and exponentials, which `decimal` rounds correctly."""
FEW = 16
"""Numbers of which each is a power by itself."""
HALVING = 2.0**27 + 1.0
"""Splits a float into two of 26 bits, whose products are exact (Dekker 1971)."""


def equal_ratios(start: float, stop: float, count: int) -> Floats:
    """Return (count,) numbers from `start` to `stop`, of one sign, as these are written.

    Both ends are exact, the others within 0.5001 units in the last place. Each is a product of two
    powers of their ratio, of which there are but 2 sqrt(count), in two floats each.
    """
    width = math.isqrt(count) if count > FEW else 1
    with localcontext() as context:
        context.prec = DIGITS
        first, last = Decimal(repr(abs(start))), Decimal(repr(abs(stop)))
        step = (last / first).ln() / max(count - 1, 1)
        rows = range(0, count, width)
        coarse = _pairs([first * (step * index).exp() for index in rows])
        fine = _pairs([(step * index).exp() for index in range(width)])
    with np.errstate(over="ignore", invalid="ignore"):  # behind the last one
        found = np.copysign(_products(coarse, fine).ravel()[:count], start)
    found[-1], found[0] = stop, start
    return np.asarray(found, np.float64)


def _pairs(numbers: Sequence[Decimal]) -> tuple[Floats, Floats]:
    """Return the nearest floats, and what they lack."""
    high = [float(number) for number in numbers]
    low = [float(number - Decimal(one)) for number, one in zip(numbers, high, strict=True)]
    return np.array(high), np.array(low)


def _products(left: tuple[Floats, Floats], right: tuple[Floats, Floats]) -> Floats:
    """Return (left, right) products of numbers that are two floats each."""
    _, scale = np.frexp(left[0])  # halving must not overflow
    (a, rest_a), (b, rest_b) = (np.ldexp(part, -scale)[:, None] for part in left), right
    high = a * b
    (a_1, a_2), (b_1, b_2) = _halves(a), _halves(b)
    low = ((a_1 * b_1 - high) + a_1 * b_2 + a_2 * b_1) + a_2 * b_2
    low += a * rest_b + rest_a * b
    return np.asarray(np.ldexp(high + low, scale[:, None]), np.float64)


def _halves(x: Floats) -> tuple[Floats, Floats]:
    upper = HALVING * x - (HALVING * x - x)
    return upper, x - upper
