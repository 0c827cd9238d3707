"""Directions in which points spread most, by powers of their covariance."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import applied, lengths, product

SQUARINGS = 40
"""Squarings of the covariance: two spreads that differ by 1e-11 of their size are told apart."""


def along_principal_directions(points: Floats, count: int) -> list[Floats]:
    """Return coordinates, (n,) each, of points (n, d) less their mean, the widest spread first.

    Of a direction and its opposite that is taken in which its largest component is positive;
    coordinates are zero along the directions that points do not have.
    """
    found = []
    left = points
    for _ in range(count):
        direction = _widest(left)
        along = applied(left, direction)
        found.append(along)
        left = left - along[:, None] * direction
    return found


def _widest(points: Floats) -> Floats:
    columns = points.T
    power = np.array([np.add.reduce(columns * column, axis=1) for column in columns])
    for _ in range(SQUARINGS):
        size = float(np.abs(power).max(initial=0.0))
        if size == 0.0:
            return np.zeros(len(columns))
        power = power / size
        power = product(power, power)
    sizes = lengths(power)
    widest = int(sizes.argmax())
    return np.asarray(power[widest] / sizes[widest], np.float64)
