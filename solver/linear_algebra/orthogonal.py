"""Complete orthogonal decomposition of a matrix of any rank, by Householder's reflections.

A P = Q [L 0; 0 0] Zᵀ with orthogonal Q and Z, a triangle L of the order of the rank and a
permutation P: columns are taken the longest first, until what is left of all is rounding; what they
have in common with the others is then reflected away from the right (Golub and Van Loan 2013,
Matrix Computations, 4th ed., algorithm 5.4.1 and section 5.4.7).
"""

import math
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.elimination import back_substituted


class _Reflection(NamedTuple):
    """I - factor v vᵀ."""

    vector: Floats
    factor: Any
    """A number, or one for each of many, (..., 1)."""

    def of(self, columns: Floats) -> None:
        """Reflect columns (..., n, columns) in place."""
        v = self.vector[..., None]
        shares = self.factor * np.add.reduce(v * columns, axis=-2)
        columns -= v * shares[..., None, :]


class Decomposition:
    """Of a matrix (rows, columns), and its rank.

    tolerance : what is left of columns is rounding if it is no longer than this share of the
    longest one; `least` : or no longer than this.
    """

    def __init__(self, matrix: Floats, tolerance: float, least: float = 0.0) -> None:
        self._columns = matrix.shape[1]
        self._left, self._upper, self._order = _triangle(matrix, tolerance, least)
        self.rank = len(self._left)

    @cached_property
    def _right(self) -> tuple[list[_Reflection], Floats]:
        """Z, and the transpose of L."""
        reflections, upper, _ = _triangle(self._upper.T)
        return reflections, upper

    def least_squares(self, right: Floats) -> Floats:
        """Return the smallest x, (columns,), with the smallest A x - b, for b (rows,)."""
        return self.least_squares_many(right[:, None])[:, 0]

    def least_squares_many(self, right: Floats) -> Floats:
        """Return the smallest X, (columns, n), with the smallest A X - B, for B (rows, n)."""
        found = np.array(right, np.float64)
        for k, reflection in enumerate(self._left):
            reflection.of(found[k:])
        rank, inner = self.rank, found[: self.rank]
        if rank == self._columns:
            return self._placed(back_substituted(self._upper, inner))
        reflections, upper = self._right
        for k in range(rank):  # L is the lower triangle
            inner[k] /= upper[k, k]
            inner[k + 1 :] -= upper[k, k + 1 :, None] * inner[k]
        whole = np.zeros((self._columns, inner.shape[1]))
        whole[:rank] = inner
        return self._turned(whole, reflections)

    @property
    def free(self) -> Floats:
        """An orthonormal basis of what the matrix maps to 0, (columns, columns - rank)."""
        freedom = self._columns - self.rank
        whole = np.zeros((self._columns, freedom))
        if freedom:
            whole[self.rank :] = np.eye(freedom)
            whole = self._turned(whole, self._right[0])
        return whole

    def _turned(self, whole: Floats, reflections: list[_Reflection]) -> Floats:
        for k in range(len(reflections) - 1, -1, -1):
            reflections[k].of(whole[k:])
        return self._placed(whole)

    def _placed(self, ordered: Floats) -> Floats:
        found = np.empty_like(ordered)
        found[self._order] = ordered
        return found


def _triangle(
    matrix: Floats, tolerance: float | None = None, least: float = 0.0
) -> tuple[list[_Reflection], Floats, list[int]]:
    """Return reflections that make a matrix an upper triangle, that, and the order of columns.

    Without a tolerance columns stay in their order, and none is rounding. Columns are not moved
    while it goes on: those that are done are reflected with the others, which costs less.
    """
    reduced = np.array(matrix, np.float64, order="C")
    rows, columns = reduced.shape
    found, done = list[_Reflection](), list[int]()
    open_still = np.ones(columns)
    for k in range(min(rows, columns)):
        left, column = reduced[k:], k
        if tolerance is not None:
            squares = np.add.reduce(left * left, axis=0) * open_still
            column = int(squares.argmax())
            size = math.sqrt(squares[column])
            if k == 0:
                least = max(least, tolerance * size)
            if not size > least:
                break
            open_still[column] = 0.0
        vector = left[:, column].copy()
        first = float(vector[0])
        if tolerance is None:
            size = math.sqrt(np.add.reduce(vector * vector))
        vector[0] = first + math.copysign(size, first)
        reflection = _Reflection(vector, 1.0 / (size * (size + abs(first))))
        reflection.of(left)
        found.append(reflection)
        done.append(column)
    order = done + [k for k in range(columns) if k not in done]
    return found, np.triu(reduced[: len(found), order]), order


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
