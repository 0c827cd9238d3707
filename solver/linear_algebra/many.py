"""Least squares of many matrices of full rank at once, by Householder's reflections.

Golub and Van Loan 2013, Matrix Computations, 4th ed., algorithm 5.2.1. Each of many is solved as if
it were alone: sums go along rows, one after the other.
"""

from typing import NamedTuple

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.elimination import back_substituted


class _Reflection(NamedTuple):
    """I - factor v vᵀ."""

    vector: Floats
    factor: Floats
    """(..., 1)."""

    def of(self, columns: Floats) -> None:
        """Reflect columns (..., n, 2 or more) in place."""
        v = self.vector[..., None]
        shares = self.factor * np.add.reduce(v * columns, axis=-2)
        columns -= v * shares[..., None, :]


def least_squares(matrix: Floats, right: Floats) -> Floats:
    """Return x, (..., n), with the smallest A x - b, for A (..., rows, n) of rank n, b (..., rows).

    Raises
    ------
    LinAlgError
        A column is a combination of those before it.
    """
    n = matrix.shape[-1]
    whole = np.concatenate([matrix, right[..., None]], axis=-1)
    _triangles(whole, n)
    return back_substituted(whole[..., :n, :n], whole[..., :n, n:])[..., 0]


def smallest(matrix: Floats, right: Floats) -> Floats:
    """Return the smallest x, (..., rows), of Aᵀ x = b, for A (..., rows, n) of rank n, b (..., n).

    Raises
    ------
    LinAlgError
        As in `least_squares`.
    """
    n = matrix.shape[-1]
    upper = matrix.copy()
    reflections = _triangles(upper, n)
    found = np.zeros((*matrix.shape[:-1], 2))  # a second column: sums of one have another order
    found[..., :n, 0] = right
    for k in range(n):
        found[..., k, :] /= upper[..., k, k, None]
        found[..., k + 1 : n, :] -= upper[..., k, k + 1 : n, None] * found[..., k, None, :]
    for k in range(n - 1, -1, -1):
        reflections[k].of(found[..., k:, :])
    return found[..., 0]


def _triangles(whole: Floats, count: int) -> list[_Reflection]:
    """Make the first columns of many matrices upper triangles, in place, and reflect the rest."""
    found: list[_Reflection] = []
    for k in range(count):
        left = whole[..., k:, k:]
        vector = left[..., 0].copy()
        size = np.sqrt(np.add.accumulate(vector * vector, axis=-1)[..., -1])
        if not size.all():
            raise LinAlgError("Singular matrix")
        first = vector[..., 0].copy()
        vector[..., 0] = first + np.copysign(size, first)
        found.append(_Reflection(vector, (1.0 / (size * (size + np.abs(first))))[..., None]))
        found[-1].of(left)
    return found
