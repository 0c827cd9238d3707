"""Complete orthogonal decomposition of a matrix of any rank, by Householder's reflections.

A P = Q [T 0; 0 0] Z: Q and Z orthogonal, T a triangle of the order of the rank, P a permutation:
columns are taken the longest first, until what is left of all is rounding; what those have in
common with the others is then reflected away from the right (Golub and Van Loan 2013, Matrix
Computations, 4th ed., algorithm 5.4.1 and section 5.4.7).

Matrices of mechanisms are small and have few entries in a row: on lists, without those that are 0,
this takes a third of the time of arrays.
"""

import math
from collections.abc import Iterable
from functools import cached_property
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats

Entry = Any
"""A number, or those of points, (points,)."""
KNOWN = 1e-4
"""Share of a column's square down to which differences tell what is left of it."""


class _Reflection:
    """I - factor v vᵀ; `vector` has the indices and entries of v that are not 0.

    `image` is what becomes of the first of the entries that it reflects; of the others nothing.
    """

    def __init__(self, column: list[float], indices: list[int], size: float) -> None:
        first = column[indices[0]]
        self.image = -math.copysign(size, first)
        self.vector = [(i, column[i]) for i in indices[1:] if column[i] != 0.0]
        self.vector.insert(0, (indices[0], first - self.image))
        self.factor = 1.0 / (size * (size + abs(first)))

    def of(self, column: list[Entry]) -> bool:
        """Reflect a column in place. Returns whether that changed it."""
        share: Entry = 0.0
        for i, entry in self.vector:
            share += entry * column[i]
        if isinstance(share, np.ndarray):
            return self._of_points(column, share)
        if share == 0.0:
            return False
        share *= self.factor
        for i, entry in self.vector:
            column[i] -= share * entry
        return True

    def _of_points(self, column: list[Entry], share: Floats) -> bool:
        """Reflect a column whose entries are (points,), each point as it would be alone."""
        kept, share = share == 0.0, share * self.factor
        for i, entry in self.vector:
            column[i] = np.where(kept, column[i], column[i] - share * entry)
        return True


class Decomposition:
    """Decomposition of a matrix (rows, columns), and its rank.

    tolerance : what is left of columns is rounding if it is no longer than this share of the
    longest one; `least` : or no longer than this.
    """

    def __init__(self, matrix: Floats, tolerance: float, least: float = 0.0) -> None:
        self._columns = matrix.T.tolist()
        self._left: list[_Reflection] = []
        self._order: list[int] = []
        self._triangle(len(matrix), tolerance, least)
        self.rank = len(self._left)

    def _triangle(self, rows: int, tolerance: float, least: float) -> None:
        columns = self._columns
        known = [_square(column) for column in columns]
        squares, waiting = known.copy(), list(range(len(columns)))
        for k in range(min(rows, len(columns))):
            pivot = max(waiting, key=squares.__getitem__)
            size = math.sqrt(_square(columns[pivot][k:]))
            least = max(least, tolerance * size) if k == 0 else least
            if not size > least:
                break
            waiting.remove(pivot)
            reflection = _Reflection(columns[pivot], list(range(k, rows)), size)
            for j in waiting:
                column = columns[j]
                if reflection.of(column) or column[k] != 0.0:
                    squares[j] -= column[k] * column[k]
                    if squares[j] < KNOWN * known[j]:
                        known[j] = squares[j] = _square(column[k + 1 :])
            columns[pivot][k] = reflection.image
            self._left.append(reflection)
            self._order.append(pivot)
        self._order += waiting

    @cached_property
    def _right(self) -> tuple[list[_Reflection], list[list[float]]]:
        """Reflections from the right, that in force first being the last, and the rows of T."""
        rank, found = self.rank, list[_Reflection]()
        rows = [[self._columns[j][i] for j in self._order] for i in range(rank)]
        beyond = list(range(rank, len(self._columns)))
        for k in range(rank - 1, -1, -1) if beyond else ():
            indices = [k, *beyond]
            size = math.sqrt(_square([rows[k][i] for i in indices]))
            reflection = _Reflection(rows[k], indices, size)
            for row in rows[:k]:
                reflection.of(row)
            rows[k][k] = reflection.image
            found.append(reflection)
        return found, rows

    def least_squares(self, right: Floats) -> Floats:
        """Return the smallest x, (columns,), with the smallest A x - b, for b (rows,).

        Or (columns, points) for (rows, points), each with the bits that it has alone.
        """
        found: list[Entry] = right.tolist() if right.ndim == 1 else list(right)
        for reflection in self._left:
            reflection.of(found)
        reflections, rows = self._right
        x: list[Entry] = [0.0] * len(self._columns)
        for k in range(self.rank - 1, -1, -1):
            total, row = found[k], rows[k]
            for j in range(k + 1, self.rank):
                total -= row[j] * x[j]
            x[k] = total / row[k]
        return self._placed(reflections, x, right.shape[1:])

    def inverse(self) -> Floats:
        """Return the pseudoinverse, (columns, rows)."""
        rows = len(self._columns[0]) if self._columns else 0
        return np.array([self.least_squares(unit) for unit in np.eye(rows)]).T

    @property
    def free(self) -> Floats:
        """An orthonormal basis of what the matrix maps to 0, (columns, columns - rank)."""
        count = len(self._columns)
        reflections, _ = self._right
        basis = [self._placed(reflections, unit) for unit in np.eye(count)[self.rank :].tolist()]
        return np.array(basis, np.float64).reshape(count - self.rank, count).T

    def _placed(
        self, reflections: list[_Reflection], x: list[Entry], points: tuple[int, ...] = ()
    ) -> Floats:
        """Return x in the order of the columns, reflected back."""
        for reflection in reversed(reflections):
            reflection.of(x)
        found = np.empty((len(x), *points))
        found[self._order] = np.broadcast_arrays(*x) if points else x
        return found


def _square(numbers: Iterable[float]) -> float:
    total = 0.0  # not what `sum` makes of them, which depends on Python's version
    for number in numbers:
        total += number * number
    return total
