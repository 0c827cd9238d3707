"""Rows of one table on their way to the disk: buffered until a whole shard of them is there."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.errors import CheckpointMismatch, InvalidAppend
from jointplay.storage.packed.running import Running
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

    def __init__(self, table: Table, files: Running) -> None:
        self.table = table
        self.durable = 0
        self.rows = 0
        self._files = files
        self._shard_rows = table.shard_rows
        self._buffers = [np.empty(self._shard_rows, column.dtype) for column in table.columns]

    def append(self, columns: Columns) -> None:
        """Add rows, writing every shard that fills up but the one with the table's last rows.

        That one goes right into the sealed store.

        Parameters
        ----------
        columns
            One (k,) array a column, in the order of the table.
        """
        count = len(columns[0])
        taken = 0
        while taken < count:
            start = self.rows - self.durable
            step = min(self._shard_rows - start, count - taken)
            for buffer, column in zip(self._buffers, columns, strict=True):
                buffer[start : start + step] = column[taken : taken + step]
            taken += step
            self.rows += step
            if self.rows - self.durable == self._shard_rows and self.rows != self.table.capacity:
                self._write_shard()

    def check_capacity(self, count: int) -> None:
        """Raise `InvalidAppend` if that many more rows are more than the layout has."""
        capacity = self.table.capacity
        if capacity is not None and self.rows + count > capacity:
            raise InvalidAppend(
                f"{self.rows} + {count} {self.table.dimension}s are more than the {capacity} "
                "of the layout"
            )

    def pending(self, first: int | None = None) -> list[NDArray[Any]]:
        """Give views of the rows not yet in a shard, from row `first` (default: all)."""
        start = 0 if first is None else max(first - self.durable, 0)
        stop = self.rows - self.durable
        return [buffer[start:stop] for buffer in self._buffers]

    def take_over(self, lost: Running, durable: int) -> None:
        """Begin with the first `durable` rows of the same table of a lost attempt's store.

        Raises
        ------
        CheckpointMismatch
            A shard of these rows is not there.
        """
        for index in range(durable // self._shard_rows):
            (key, *_) = self.shard_keys(index)
            try:
                self._files.adopt(lost, key)
            except FileNotFoundError as error:
                raise CheckpointMismatch(
                    f"{lost.folder} lacks {key}, which the checkpoint builds on"
                ) from error
        self.rows = self.durable = durable

    def files(self) -> Iterator[tuple[str, bytes]]:
        """Give key and content of every file of the table, in order of their rows."""
        for index in range(self.durable // self._shard_rows):
            yield from self._files.chunks(self.shard_keys(index)[0])
        if self.rows > self.durable:
            yield from self._next_shard()

    def shard_keys(self, index: int) -> list[str]:
        """Name the files that hold a shard of every column."""
        return [f"{self.table.key(column.name)}/c/{index}" for column in self.table.columns]

    def _write_shard(self) -> None:
        self._files.write(self._next_shard(), self.shard_keys(self.durable // self._shard_rows)[0])
        self.durable = self.rows

    def _next_shard(self) -> Iterator[tuple[str, bytes]]:
        """Encode the waiting rows as the files of the next shard."""
        keys = self.shard_keys(self.durable // self._shard_rows)
        return zip(keys, self._contents(), strict=True)

    def _contents(self) -> Iterator[bytes]:
        """Encode the waiting rows of each column, in the order of `shard_keys`."""
        for rows in self.pending():
            yield shards.encode(rows, self.table.chunk_rows, self._shard_rows)
