"""Gaussian elimination with partial pivoting, of many systems at once.

Golub and Van Loan 2013, Matrix Computations, 4th ed., algorithm 3.4.1. There is no sum in it: each
of many systems is solved as if it were alone.
"""

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats


def solve(matrix: Floats, right: Floats) -> Floats:
    """Return x, (..., n), of A x = b, for A (..., n, n) and b (..., n).

    Raises
    ------
    LinAlgError
        A matrix is singular.
    """
    return solve_many(matrix, right[..., None])[..., 0]


def solve_many(matrix: Floats, right: Floats) -> Floats:
    """Return X, (..., n, columns), of A X = B, for A (..., n, n) and B (..., n, columns).

    Raises
    ------
    LinAlgError
        A matrix is singular.
    """
    n, columns = right.shape[-2:]
    whole = np.concatenate([matrix, right], axis=-1).reshape(-1, n, n + columns)
    with np.errstate(over="ignore", invalid="ignore"):
        for k in range(n):
            _exchange(whole, k)
            pivot = whole[:, k, k]
            if not pivot.all():
                raise LinAlgError("Singular matrix")
            shares = whole[:, k + 1 :, k] / pivot[:, None]
            whole[:, k + 1 :, k + 1 :] -= shares[:, :, None] * whole[:, k, None, k + 1 :]
        found = back_substituted(whole[:, :, :n], whole[:, :, n:])
    return found.reshape(right.shape)


def back_substituted(upper: Floats, right: Floats) -> Floats:
    """Return X, (..., n, columns), of U X = B, in the place of B; U is an upper triangle."""
    for k in range(right.shape[-2] - 1, -1, -1):
        right[..., k, :] /= upper[..., k, k, None]
        right[..., :k, :] -= upper[..., :k, k, None] * right[..., k, None, :]
    return right


def _exchange(whole: Floats, k: int) -> None:
    """Bring the row of the largest pivot to place k, in each system."""
    rows = np.abs(whole[:, k:, k]).argmax(axis=1)
    moved = np.flatnonzero(rows)
    if len(moved):
        rows = rows[moved] + k
        first = whole[moved, k]
        whole[moved, k] = whole[moved, rows]
        whole[moved, rows] = first
