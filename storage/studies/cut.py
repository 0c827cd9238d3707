"""Chunks of arrays with a number a point, or some: cut along one axis, or over two."""

import math
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Integers
from jointplay.storage.studies.layout import StudyLayout

CHUNK_VALUES: Final = 16_384
"""Most values that are compressed together along one axis."""
SIDE: Final = 256
"""Points of a chunk along each of two axes; of a narrow map as many points in all."""


class Band(NamedTuple):
    """One row of chunks: its number along the first axis, and the points in it."""

    row: int
    points: tuple[slice, ...]
    """Runs of consecutive points: one along one axis, of a map one of each level."""
    indices: Integers
    """Index of each of these points in the band, row by row."""


def chunk_shape(layout: StudyLayout, width: int = 1) -> list[int]:
    """Return the points in a chunk along each axis, where a point has `width` numbers."""
    width = max(width, 1)
    if len(layout.shape) == 1:
        return [max(min(layout.points, CHUNK_VALUES // width), 1)]
    side = max(int(SIDE / math.sqrt(width)), 1)
    height, across = layout.shape
    step = min(across, side)
    return [min(height, side * side // step), step]  # taller where a map is narrow


def bands(layout: StudyLayout, width: int = 1) -> Iterator[Band]:
    """Yield the rows of chunks, in order."""
    height, *_ = chunk_shape(layout, width)
    if len(layout.shape) == 1:
        for row, begin in enumerate(range(0, layout.points, height)):
            count = min(height, layout.points - begin)
            yield Band(row, (slice(begin, begin + count),), np.arange(count))
        return
    whole, across = layout.shape
    of_band, indices = np.divmod(layout.order, height * across)
    by_band = np.argsort(of_band, kind="stable")  # in each, the points in their order
    ends = np.minimum(np.arange(1, -(-whole // height) + 1) * height, whole) * across
    for row, members in enumerate(np.split(by_band, ends[:-1])):
        runs = np.split(members, np.flatnonzero(np.diff(members) > 1) + 1)
        points = tuple(slice(int(run[0]), int(run[-1]) + 1) for run in runs)
        yield Band(row, points, indices[members])


def chunks(
    layout: StudyLayout, band: Band, numbers: NDArray[Any], width: int = 1
) -> Iterator[tuple[str, NDArray[Any]]]:
    """Yield the index, such as ``3`` or ``3/0``, and the numbers of each chunk of a band.

    `numbers` : (points of the band, ...), in the order of the points.
    """
    if len(layout.shape) == 1:
        yield str(band.row), numbers
        return
    _, across = layout.shape
    _, step = chunk_shape(layout, width)
    table = np.empty_like(numbers)
    table[band.indices] = numbers
    table = table.reshape(-1, across, *numbers.shape[1:])
    for column, begin in enumerate(range(0, across, step)):
        yield f"{band.row}/{column}", table[:, begin : begin + step]
