"""Smallest and largest values of a history in buckets, written as it grows.

What is drawn of ten million samples has a few thousand points; the pyramid has them ready. Its
levels have buckets of 64 samples, 16 times as many, and so on. A level is one array of (buckets,
2 columns), the minimum and the maximum of each channel and of the time side by side, and a file of
it holds all columns of some buckets. It is no part of what clients are shown: `storage.results`
reads it itself.
"""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.names import TIME
from jointplay.storage.packed.running import Running
from jointplay.storage.results import metadata, shards
from jointplay.storage.results.growing_table import Columns, GrowingTable
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.metadata import DOUBLE
from jointplay.storage.results.tables import Column, Table

GROUP: Final = "pyramid"
ARRAY: Final = "extremes"
"""Name of a level's array in the group that its number of samples names."""
FACTOR: Final = 16
"""Buckets of one level that make a bucket of the next."""

_FEWEST: Final = 16  # buckets of the coarsest level


class Level(GrowingTable):
    """One level: rows are buckets, columns minimum and maximum of each column in turn.

    Parameters
    ----------
    layout
        Of the store.
    size
        Samples of a bucket.
    files
        Where its files are written.
    """

    def __init__(self, layout: ResultLayout, size: int, files: Running) -> None:
        names = [*(channel.name for channel in layout.channels), TIME]
        columns = tuple(
            Column(f"{name} {extreme}", DOUBLE, {})
            for name in names
            for extreme in ("minimum", "maximum")
        )
        rows = layout.partition.level_rows
        group = f"{GROUP}/{size}"
        self.size = size
        self.capacity = -(-layout.samples // size)
        super().__init__(Table(group, "bucket", columns, None, rows, rows, {}), files)

    def shard_keys(self, index: int) -> list[str]:
        """Name the one chunk of a shard, which holds all columns."""
        return [f"{self.table.key(ARRAY)}/c/{index}/0"]

    def document(self) -> tuple[str, metadata.Document]:
        """Give key and document of the level's array, as long as the history will be."""
        width, rows = len(self.table.columns), self.table.shard_rows
        return f"{self.table.key(ARRAY)}/{metadata.FILE}", metadata.array(
            [self.capacity, width],
            [rows, 2],
            DOUBLE,
            ["bucket", "extreme"],
            {"long_name": f"minimum and maximum of each column in buckets of {self.size} samples"},
            shard=[rows, width],
        )

    def _contents(self, columns: Columns) -> Iterator[bytes]:
        rows = self.table.shard_rows
        whole = np.full((rows, 2), np.nan)
        chunks = []
        for minimum, maximum in zip(columns[::2], columns[1::2], strict=True):
            whole[: len(minimum), 0] = minimum
            whole[: len(minimum), 1] = maximum
            chunks.append(shards.compress(whole))
        yield shards.pack(chunks)


class Pyramid:
    """The levels of a growing history; none if it will be short.

    Parameters
    ----------
    layout
        Of the store.
    history
        The table that it follows.
    files
        Where files are written.
    """

    def __init__(self, layout: ResultLayout, history: GrowingTable, files: Running) -> None:
        self._history = history
        self._bucket = layout.partition.bucket
        self.levels = [Level(layout, size, files) for size in _sizes(layout, history)]

    def append(self, columns: Columns) -> None:
        """Follow rows that are about to be appended to the history."""
        if self.levels and len(columns[0]):
            whole = _joined(self._history, columns, self._bucket)
            self._add(0, [extreme for column in whole for extreme in _folded(column, self._bucket)])

    def close(self) -> None:
        """Add the buckets that will not fill any more."""
        if not self.levels:
            return
        rest = self._history.rows % self._bucket
        if rest:
            last = self._history.pending(self._history.rows - rest)
            self._add(0, [extreme for column in last for extreme in _folded(column, rest)])
        for below, level in zip(self.levels, self.levels[1:], strict=False):
            if rest := below.rows % FACTOR:
                level.append(_raised(below.pending(below.rows - rest), rest))

    def documents(self) -> dict[str, metadata.Document]:
        """Give the documents of the levels' arrays by key."""
        return dict(level.document() for level in self.levels)

    def _add(self, position: int, columns: Columns) -> None:
        level = self.levels[position]
        if position + 1 < len(self.levels):
            whole = _joined(level, columns, FACTOR)
            raised = _raised(whole, FACTOR)
            level.append(columns)
            self._add(position + 1, raised)
        else:
            level.append(columns)


def _sizes(layout: ResultLayout, history: GrowingTable) -> Iterator[int]:
    """Give samples of a bucket at each level."""
    partition = layout.partition
    if layout.samples <= partition.pyramid_above or history.table.shard_rows % partition.bucket:
        return
    size = partition.bucket
    while layout.samples // size >= _FEWEST:
        yield size
        size *= FACTOR


def _joined(table: GrowingTable, columns: Columns, size: int) -> list[NDArray[Any]]:
    """Put new rows behind those that make no whole bucket yet; as many as make whole ones."""
    rest = table.rows % size
    total = (rest + len(columns[0])) // size * size
    if not rest:
        return [column[:total] for column in columns]
    begun = table.pending(table.rows - rest)
    return [
        np.concatenate([head, column])[:total] for head, column in zip(begun, columns, strict=True)
    ]


def _folded(column: NDArray[Any], size: int) -> tuple[NDArray[Any], NDArray[Any]]:
    buckets = np.ascontiguousarray(column).reshape(-1, size)
    return np.fmin.reduce(buckets, axis=1), np.fmax.reduce(buckets, axis=1)


def _raised(columns: Columns, size: int) -> list[NDArray[Any]]:
    """Fold minima and maxima of one level into those of the next."""
    return [
        (np.fmax if position % 2 else np.fmin).reduce(column.reshape(-1, size), axis=1)
        for position, column in enumerate(columns)
    ]
