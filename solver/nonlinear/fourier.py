"""Fourier transforms of columns (n, d), in real arithmetic: sums have one order.

Lengths that are powers of two by Stockham's algorithm; others by Bluestein's, as a convolution with
a chirp (Van Loan 1992, Computational Frameworks for the Fast Fourier Transform, 1.7 and 4.2.3).
"""

import math
from functools import lru_cache

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.scalars import sine_cosine

SHORT = 256
"""Numbers of a row below which a loop over them takes longer to begin than to run."""

Complex = tuple[Floats, Floats]
"""Real and imaginary parts."""


def times(first: Complex, second: Complex) -> Complex:
    """Return the product of two."""
    (a, b), (c, d) = first, second
    return a * c - b * d, a * d + b * c


def conjugate(z: Complex) -> Complex:
    """Return the conjugate."""
    return z[0], -z[1]


def transformed(z: Complex) -> Complex:
    """Return Σ_j z_j exp(-2πi jk/n) for k from 0 to n - 1."""
    n = len(z[0])
    if power_of_two(n) == n:
        return _by_halves(z)
    k = np.arange(n)
    sine, cosine = sine_cosine((math.pi / n) * (k * k % (2 * n))[:, None])  # without whole turns
    chirp = cosine, -sine
    size = power_of_two(2 * n - 1)
    back = np.zeros((2, size, 1))
    back[:, :n], back[:, size - n + 1 :] = (cosine, sine), (cosine[:0:-1], sine[:0:-1])
    spread = _by_halves(padded(times(z, chirp), size))
    real, imaginary = inverse(times(spread, _by_halves((back[0], back[1]))))
    return times((real[:n], imaginary[:n]), chirp)


def inverse(z: Complex) -> Complex:
    """Return what `transformed` makes z of; the length is a power of two."""
    real, imaginary = _by_halves(conjugate(z))
    return real / len(real), imaginary / -len(real)


def power_of_two(least: int) -> int:
    """Return the smallest power of two that is not below a number."""
    return 1 << max(least - 1, 0).bit_length()


def padded(z: Complex, size: int) -> Complex:
    """Return z with rows of zeros behind it."""
    real, imaginary = (np.zeros((size, part.shape[1])) for part in z)
    real[: len(z[0])], imaginary[: len(z[1])] = z
    return real, imaginary


def _by_halves(z: Complex) -> Complex:
    """Return the transform for a length that is a power of two."""
    n, columns = z[0].shape
    half, stride = n // 2, 1
    while half:  # transforms of 2 half places each are put together of those of even and odd ones
        (a, b), (c, d) = (part.reshape(2, half, stride * columns) for part in z)
        cosine, sine = _turns(n, half, columns if stride * columns < SHORT else 1)
        joined = np.empty((2, half, 2, stride * columns))
        np.add(a, b, out=joined[0, :, 0])
        np.add(c, d, out=joined[1, :, 0])
        a, c = a - b, c - d
        np.multiply(a, cosine, out=joined[0, :, 1])
        joined[0, :, 1] -= c * sine
        np.multiply(a, sine, out=joined[1, :, 1])
        joined[1, :, 1] += c * cosine
        z = joined[0], joined[1]
        half, stride = half // 2, 2 * stride
    return z[0].reshape(n, columns), z[1].reshape(n, columns)


@lru_cache(maxsize=64)  # as many as a few lengths have of stages
def _turns(n: int, half: int, columns: int) -> Complex:
    """Return exp(-2πi j/2 half) for j below half, from the turns of a transform of length n.

    (half, 1) each; with `columns` repeated for each number of a row, (half, stride columns), for
    loops over short rows take longer than what they compute.
    """
    sine, cosine = sine_cosine((2.0 * math.pi / n) * np.arange(n // 2)[:: n // (2 * half), None])
    times_over = 1 if columns == 1 else n // (2 * half) * columns
    return np.repeat(cosine, times_over, axis=1), np.repeat(-sine, times_over, axis=1)
