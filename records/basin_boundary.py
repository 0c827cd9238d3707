"""Dimension of the boundary between basins of attraction, from a map of labels."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.motion import FAILED, UNDECIDED, WAITING, Labels


@dataclass(frozen=True)
class BoundaryDimension:
    """Dimension of the boundary between basins on a map, by the uncertainty exponent.

    The share of points with a neighbour at a distance that ends elsewhere falls as the distance to
    the power 2 - D (Grebogi, McDonald, Ott and Yorke 1983).
    """

    value: float
    error: float
    """Standard error of the slope, and how far it is from one that allows for the end of growth."""
    distances: tuple[int, ...]
    """Points between neighbours."""
    shares: tuple[float, ...]
    """Shares of points whose neighbours end elsewhere."""


FEWEST: Final = 30
"""Points whose neighbours end elsewhere, below which a distance says nothing."""
MOST: Final = 0.4
"""Share of such points, in that of independent labels, above which a distance is as long as basins
are wide: the share cannot grow as it does at small distances."""


def boundary_dimension(labels: Labels) -> BoundaryDimension | None:
    """Return the dimension of the boundaries of a map, (y, x); None where too few points tell it.

    Points that wait, failed or are undecided end nowhere known: they are no neighbours.
    """
    known = ~np.isin(labels, (WAITING, FAILED, UNDECIDED))
    distances, shares, counts = [], [], []
    most, distance = _share_of_independent(labels[known]), 1
    while distance <= min(labels.shape) // 8:
        differ, told = _uncertain(labels, known, distance)
        if differ >= FEWEST and differ <= MOST * most * told:
            distances.append(distance)
            shares.append(differ / told)
            counts.append(differ)
        distance *= 2
    if len(distances) < 3:
        return None
    x, weights = np.log(distances), np.sqrt(np.array(counts, np.float64))
    slope, error = _slope(x, np.log(shares), weights)
    ending, _ = _slope(x, np.log(-np.log1p(-np.array(shares) / most)), weights)
    error = math.hypot(error, ending - slope)
    return BoundaryDimension(2.0 - slope, error, tuple(distances), tuple(shares))


def _share_of_independent(labels: Labels) -> float:
    """Return the share of points with a neighbour, of four, of another label, if all were drawn."""
    _, counts = np.unique(labels, return_counts=True)
    return 1.0 - float(np.sum((counts / max(len(labels), 1)) ** 5))


def _slope(x: Floats, y: Floats, weights: Floats) -> tuple[float, float]:
    """Return the slope of the line through points, and its standard error by their scatter."""
    table = np.stack([x, np.ones_like(x)], axis=1)
    inverse = np.linalg.inv((table * weights[:, None] ** 2).T @ table)
    slope, level = inverse @ (table * weights[:, None] ** 2).T @ y
    left = (y - slope * x - level) * weights
    spread = max(float(left @ left) / (len(x) - 2), 1.0)
    return float(slope), math.sqrt(float(inverse[0, 0]) * spread)


def _uncertain(labels: Labels, known: Flags, distance: int) -> tuple[int, int]:
    """Return how many points have a neighbour that ends elsewhere, and how many have neighbours."""
    differ, told = np.zeros(labels.shape, np.bool_), np.zeros(labels.shape, np.bool_)
    for axis in (0, 1):
        for sign in (-1, 1):
            other = np.roll(labels, sign * distance, axis)
            there = np.roll(known, sign * distance, axis) & known
            edge: list[slice] = [slice(None), slice(None)]
            edge[axis] = slice(0, distance) if sign > 0 else slice(-distance, None)
            there[tuple(edge)] = False
            differ |= there & (other != labels)
            told |= there
    return int(differ.sum()), int(told.sum())
