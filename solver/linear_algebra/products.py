"""Sums of products in a fixed order."""

import math

import numpy as np

from jointplay.records.arrays import Floats


def product(first: Floats, second: Floats) -> Floats:
    """Return matrices (..., rows, n) times matrices (..., n, columns), added up from the first."""
    lead = np.broadcast_shapes(first.shape[:-2], second.shape[:-2])
    total = np.zeros((*lead, first.shape[-2], second.shape[-1]))
    for k in range(first.shape[-1]):
        total += first[..., :, k, None] * second[..., k, None, :]
    return total


def applied(matrix: Floats, vector: Floats) -> Floats:
    """Return matrices (..., rows, n) times vectors (..., n)."""
    return product(matrix, vector[..., None])[..., 0]


def lengths(rows: Floats) -> Floats:
    """Return the Euclidean length of each row of a matrix, (rows,)."""
    return np.asarray(np.sqrt(np.add.reduce(rows * rows, axis=1)), np.float64)


def length(vector: Floats) -> float:
    """Return the Euclidean length of a vector (n,)."""
    return math.sqrt(float(np.add.reduce(vector * vector)))
