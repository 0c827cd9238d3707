"""Cells of a map that is refined: which are split, which points are computed, who inherits.

A cell is a square of 2^k points on a side; its first point is its origin. One whose corners differ
is split into four. Every origin is computed; the other points of a cell that is not split have the
results of its origin. So the results of a point depend on the cells that it lies in, and not on
which part of the map is computed together.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Flags, Integers

Differ = Callable[[Integers], Flags]
"""From (cells, 4) indices of corners to (cells,) whether they differ."""


@dataclass(frozen=True)
class Cells:
    """Decisions on cells by the points that are known; an index is y * width + x."""

    missing: tuple[int, ...]
    """Indices of points that must be known next; none: every cell is decided."""
    computed: frozenset[int]
    """Indices of points whose own results count, but for the origins of the coarsest cells."""
    inherited: dict[int, int]
    """From the indices of points to that of the origin whose results they have."""


def decided(
    origins: Integers,
    shape: tuple[int, ...],
    depth: int,
    known: Callable[[int], bool],
    differ: Differ,
) -> Cells:
    """Return how far cells can be split.

    Parameters
    ----------
    origins
        (cells,) indices of the origins of cells with 2^depth points on a side.
    shape
        (height, width) of the map. A cell that reaches beyond it has corners at its edge.
    known
        Whether the point at an index is known.
    differ
        Which cells' corners differ.
    """
    side, computed, inherited = 1 << depth, set[int](), dict[int, int]()
    while True:
        corners = _corners(origins, side, shape)
        needed = corners if side > 1 else corners[:, 0]
        missing = tuple(one for one in dict.fromkeys(needed.ravel().tolist()) if not known(one))
        if missing or side == 1 or not len(origins):
            return Cells(missing, frozenset(computed), inherited)
        apart = differ(corners)
        for origin in origins[~apart].tolist():
            inside = _points(origin, side, 1, shape)[1:].tolist()
            inherited |= dict.fromkeys(inside, origin)
        side //= 2
        quarters = [_points(one, 2 * side, side, shape) for one in origins[apart].tolist()]
        for each in quarters:
            computed |= set(each[1:].tolist())
        origins = np.concatenate([np.zeros(0, np.int64), *quarters])


def _corners(origins: Integers, side: int, shape: tuple[int, ...]) -> Integers:
    """Return (cells, 4) indices of corners, the origin first."""
    height, width = shape
    y, x = np.divmod(origins, width)
    above, right = np.minimum(y + side, height - 1), np.minimum(x + side, width - 1)
    return np.stack([y * width + x, y * width + right, above * width + x, above * width + right], 1)


def _points(origin: int, side: int, step: int, shape: tuple[int, ...]) -> Integers:
    """Return indices of every `step`-th point of a cell, as far as it is on the map."""
    height, width = shape
    y, x = divmod(origin, width)
    rows = np.arange(y, min(y + side, height), step)
    return np.asarray(
        (rows[:, None] * width + np.arange(x, min(x + side, width), step)).ravel(), np.int64
    )
