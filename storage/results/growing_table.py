"""Rows of one table on their way to the disk: buffered until a whole file of them is there."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.errors import CheckpointMismatch, InvalidAppend
from jointplay.storage.packed.running import Running, indices_in_file
from jointplay.storage.results import shards
from jointplay.storage.results.tables import Table

Columns = Sequence[NDArray[Any]]


class GrowingTable:
    """One table being written: `rows` were appended, `durable` of them are in shards.

    What is on the disk depends on the rows alone, never on how appending was sliced.

    Parameters
    ----------
    table
        Columns and shard size.
    files
        Where shards are written.
    """

    _AT_ONCE: ClassVar = 1
    """Files that are written one after the other when all are full."""

    def __init__(self, table: Table, files: Running) -> None:
        self.table = table
        self.durable = 0
        self.rows = 0
        self._files = files
        self._file_shards = indices_in_file(self.shard_keys(0)[0])
        self._file_rows = table.shard_rows * self._file_shards

    @cached_property
    def _buffers(self) -> list[NDArray[Any]]:
        """Room for the rows that wait; many a table never has any."""
        rows = self._file_rows * self._AT_ONCE
        return [np.empty(rows, column.dtype) for column in self.table.columns]

    def append(self, columns: Columns) -> None:
        """Add rows, writing every file that fills up but the one with the table's last rows.

        That one goes right into the sealed store.

        Parameters
        ----------
        columns
            One (k,) array a column, in the order of the table.
        """
        count, room = len(columns[0]), self._file_rows * self._AT_ONCE
        taken = 0
        while taken < count:
            start = self.rows - self.durable
            step = min(room - start, count - taken)
            for buffer, column in zip(self._buffers, columns, strict=True):
                buffer[start : start + step] = column[taken : taken + step]
            taken += step
            self.rows += step
            if self.rows - self.durable == room and self.rows != self.table.capacity:
                self._write()

    def check_capacity(self, count: int) -> None:
        """Raise `InvalidAppend` if that many more rows are more than the layout has."""
        capacity = self.table.capacity
        if capacity is not None and self.rows + count > capacity:
            raise InvalidAppend(
                f"{self.rows} + {count} {self.table.dimension}s are more than the {capacity} "
                "of the layout"
            )

    def pending(self, first: int) -> list[NDArray[Any]]:
        """Give views of the rows not yet in a shard, from row `first` on."""
        start, stop = max(first - self.durable, 0), self.rows - self.durable
        return [buffer[start:stop] for buffer in self._buffers]

    def take_over(self, lost: Running, durable: int) -> None:
        """Begin with the first `durable` rows of the same table of a lost attempt's store.

        Raises
        ------
        CheckpointMismatch
            A shard of these rows is not there.
        """
        for key in self._files_of(durable):
            try:
                self._files.adopt(lost, key)
            except FileNotFoundError as error:
                raise CheckpointMismatch(
                    f"{lost.folder} lacks {key}, which the checkpoint builds on"
                ) from error
        self.rows = self.durable = durable

    def files(self) -> Iterator[tuple[str, bytes]]:
        """Give key and content of every file of the table, in order of their rows."""
        for key in self._files_of(self.durable):
            yield from self._files.chunks(key)
        yield from self._chunks(self.durable, self.rows)

    def shard_keys(self, index: int) -> list[str]:
        """Name the chunks of a shard: by default one of every column."""
        return [f"{self.table.key(column.name)}/c/{index}" for column in self.table.columns]

    def _files_of(self, durable: int) -> list[str]:
        """Give the key of the first chunk in each file of so many rows."""
        shard_rows, together = self.table.shard_rows, self._file_shards
        return [self.shard_keys(index)[0] for index in range(0, durable // shard_rows, together)]

    def _write(self) -> None:
        for first in range(self.durable, self.rows, self._file_rows):
            key = self.shard_keys(first // self.table.shard_rows)[0]
            self._files.write(self._chunks(first, first + self._file_rows), key)
        self.durable = self.rows

    def _chunks(self, first: int, last: int) -> Iterator[tuple[str, bytes]]:
        """Encode waiting rows [first, last), from the first of a shard on, as chunks."""
        rows = self.table.shard_rows
        for begin in range(first, last, rows):
            start, stop = (row - self.durable for row in (begin, min(begin + rows, last)))
            columns = [buffer[start:stop] for buffer in self._buffers]
            yield from zip(self.shard_keys(begin // rows), self._contents(columns), strict=True)

    def _contents(self, columns: Columns) -> Iterator[bytes]:
        """Encode the rows of one shard, in the order of `shard_keys`."""
        for rows in columns:
            yield shards.encode(rows, self.table.chunk_rows, self.table.shard_rows)
