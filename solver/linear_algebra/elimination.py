"""Gaussian elimination with partial pivoting, of one system or of many at once.

Golub and Van Loan 2013, Matrix Computations, 4th ed., algorithm 3.4.1. There is no sum in it: each
of many systems is solved as if it were alone. A small one alone goes by lists, without its zeros.
"""

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats

FEW = 24
"""Unknowns up to which one system is solved by lists."""


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
    if right.ndim == 2 and n <= FEW:
        return np.array(_solved(matrix.tolist(), right.tolist())).reshape(n, columns)
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


def _solved(matrix: list[list[float]], right: list[list[float]]) -> list[list[float]]:
    """Return what `solve_many` returns, of one system."""
    rows = [[*one, *more] for one, more in zip(matrix, right, strict=True)]
    n = len(rows)
    for k in range(n):
        largest = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[largest] = rows[largest], rows[k]
        pivot, *behind = rows[k][k:]
        if not pivot:
            raise LinAlgError("Singular matrix")
        for row in _with(k, rows[k + 1 :]):
            share = row[k] / pivot
            row[k + 1 :] = [x - share * y for x, y in zip(row[k + 1 :], behind, strict=True)]
    for k in range(n - 1, -1, -1):
        rows[k][n:] = found = [x / rows[k][k] for x in rows[k][n:]]
        for row in _with(k, rows[:k]):
            share = row[k]
            row[n:] = [x - share * y for x, y in zip(row[n:], found, strict=True)]
    return [row[n:] for row in rows]


def _with(k: int, rows: list[list[float]]) -> list[list[float]]:
    return [row for row in rows if row[k]]


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
