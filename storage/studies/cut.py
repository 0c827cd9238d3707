"""Chunks of arrays with a number a point, or some: cut along one axis, or over two."""

import math
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

from numpy.typing import NDArray

from jointplay.storage.studies.layout import StudyLayout

CHUNK_VALUES: Final = 16_384
"""Most values that are compressed together along one axis."""
SIDE: Final = 256
"""Points of a chunk along each of two axes."""


class Band(NamedTuple):
    """One row of chunks: its place along the first axis, and the points in it."""

    row: int
    first: int
    stop: int


def chunk_shape(layout: StudyLayout, width: int = 1) -> list[int]:
    """Return the points in a chunk along each axis, where a point has `width` numbers."""
    width = max(width, 1)
    if len(layout.shape) == 1:
        return [max(min(layout.points, CHUNK_VALUES // width), 1)]
    side = max(int(SIDE / math.sqrt(width)), 1)
    return [min(size, side) for size in layout.shape]


def bands(layout: StudyLayout, width: int = 1) -> Iterator[Band]:
    """Yield the rows of chunks, in order."""
    height, *_ = chunk_shape(layout, width)
    whole, *others = layout.shape
    across = math.prod(others)
    for row, begin in enumerate(range(0, whole, height)):
        yield Band(row, begin * across, min(begin + height, whole) * across)


def chunks(
    layout: StudyLayout, band: Band, numbers: NDArray[Any], width: int = 1
) -> Iterator[tuple[str, NDArray[Any]]]:
    """Yield the place, such as ``3`` or ``3/0``, and the numbers of each chunk of a band.

    `numbers` : (points of the band, ...).
    """
    if len(layout.shape) == 1:
        yield str(band.row), numbers
        return
    _, across = layout.shape
    _, step = chunk_shape(layout, width)
    table = numbers.reshape(-1, across, *numbers.shape[1:])
    for column, begin in enumerate(range(0, across, step)):
        yield f"{band.row}/{column}", table[:, begin : begin + step]
