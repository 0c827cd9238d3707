"""The largest magnitude of an eigenvalue, from powers of the matrix (Gelfand's formula)."""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import product


def spectral_radius(matrix: Floats, squarings: int) -> float:
    """Return a bound of it from above, for a square matrix (n, n).

    It is the root of order 2^squarings of the length of so high a power: beyond the radius by that
    root of the number n for a normal matrix, and of its eigenvectors' condition for any.
    """
    sizes: list[float] = []
    power = matrix
    for _ in range(squarings):
        size = float(np.abs(power).max(initial=0.0))
        if size == 0.0:
            break
        sizes.append(size)
        power = power / size
        power = product(power, power)
    radius = float(np.sqrt(np.add.reduce((power * power).ravel())))
    for size in reversed(sizes):
        radius = size * math.sqrt(radius)
    return radius
