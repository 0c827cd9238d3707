"""The order in which the points of a grid of two axes are computed: coarse to fine.

Every 64th point of both axes comes first, then what every 32nd adds, and so on: after a 64th of the
work a picture of an eighth of the resolution stands. Points of one level come tile by tile, so that
those of a tile are near one another in the order.  Where each point starts from its neighbour along
a row, whole rows come coarse to fine. Where a coarse grid is refined, that comes first, in the same
order, and then tile by tile what is between.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Integers

COARSEST = 6
"""Level of the points that come first: they are 2^6 apart."""
TILE = 256
"""Points along each side of a tile."""


def over_axes(values: NDArray[Any], order: Integers, shape: tuple[int, ...]) -> NDArray[Any]:
    """Return values of points in the order of computing, (points, ...), as (y, x, ...)."""
    laid = np.empty_like(values)
    laid[order] = values
    return laid.reshape(*shape, *values.shape[1:])


def levels(y: Integers, x: Integers) -> Integers:
    """Return the level of points: the largest k, at most 6, for which 2^k divides both indices."""
    either = y | x | (1 << COARSEST)
    return np.asarray(np.log2(either & -either), np.int64)  # of a power of two, exactly


def order_of(job: Mapping[str, Any], shape: tuple[int, ...]) -> Integers:
    """Return (points,) the flat index of each point of a map in the order of computing.

    Parameters
    ----------
    job
        The map's document: its start rule decides, and to which depth it is refined.
    shape
        (height, width): numbers of values along y and x.
    """
    if depth := int(job.get("refine", 0)):
        return refined(shape, depth)
    chained = job.get("continuation", "none") != "none"
    return rows_coarse_to_fine(shape) if chained else coarse_to_fine(shape)


@lru_cache(4)
def rows_coarse_to_fine(shape: tuple[int, ...]) -> Integers:
    """Return the order of whole rows: every 64th, then what every 32nd adds, and so on."""
    height, width = shape
    rows = np.arange(height)
    coarse_first = np.argsort(-levels(rows, np.zeros_like(rows)), kind="stable")
    order = (coarse_first[:, None] * width + np.arange(width)).ravel()
    order.flags.writeable = False
    return order


def coarse_points(shape: tuple[int, ...], depth: int) -> int:
    """Return how many points a grid of every 2^depth-th point has."""
    return -(-shape[0] >> depth) * (-(-shape[1] >> depth))


@lru_cache(4)
def refined(shape: tuple[int, ...], depth: int) -> Integers:
    """Return the order of a map whose every 2^depth-th point comes first, then tile by tile."""
    order, coarse = coarse_to_fine(shape), coarse_points(shape, depth)
    by_tile = np.argsort(tiles(order[coarse:], shape), kind="stable")
    found = np.concatenate([order[:coarse], order[coarse:][by_tile]])
    found.flags.writeable = False
    return found


def tiles(indices: Integers, shape: tuple[int, ...]) -> Integers:
    """Return the number of the tile of 64 x 64 points that each lies in, row by row."""
    y, x = np.divmod(indices, shape[1])
    return np.asarray((y >> COARSEST) * (-(-shape[1] >> COARSEST)) + (x >> COARSEST), np.int64)


@lru_cache(4)  # of a million points it takes a tenth of a second, and 8 MB
def coarse_to_fine(shape: tuple[int, ...]) -> Integers:
    """Return (points,) the flat index, y * width + x, of each point in the order of computing.

    Those of the shapes that were asked for last are kept: they cannot be written to.

    Parameters
    ----------
    shape
        (height, width): numbers of values along y and x.
    """
    height, width = shape
    y, x = (each.ravel() for each in np.indices(shape, dtype=np.int64))
    across = -(-width // TILE)
    level = COARSEST - levels(y, x)
    tile = (y // TILE) * across + x // TILE
    tiles = across * -(-height // TILE)
    order = np.argsort((level * tiles + tile) * len(y) + y * width + x)
    order.flags.writeable = False
    return order
