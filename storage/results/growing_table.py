"""Rows of one table on their way to the disk: buffered until a whole shard of them is there."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.results import shards
from jointplay.storage.results.durable import DurableFolder
from jointplay.storage.results.errors import CheckpointMismatch, InvalidAppend
from jointplay.storage.results.tables import Table

Columns = Sequence[NDArray[Any]]


class GrowingTable:
    """One table being written: `rows` were appended, `durable` of them are in shards.

    What is on the disk depends on the rows alone, never on how appending was sliced.

    Parameters
    ----------
    table
        Columns and shard size.
    folder
        Where shards are written.
    """

    def __init__(self, table: Table, folder: DurableFolder) -> None:
        self.table = table
        self.durable = 0
        self.rows = 0
        self._folder = folder
        self._shard_rows = table.shard_rows
        self._buffers = [np.empty(self._shard_rows, column.dtype) for column in table.columns]

    def append(self, columns: Columns) -> None:
        """Add rows, writing every shard that fills up but the one with the table's last rows.

        That one waits for `finishing`, where all tables' last shards go to the disk together.

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

    def take_over(self, source: Path, durable: int) -> None:
        """Begin with the first `durable` rows of the same table of another store.

        Raises
        ------
        CheckpointMismatch
            A shard of these rows is not there.
        """
        for key in self.shard_keys(0, durable // self._shard_rows):
            try:
                self._folder.adopt(key, source / key)
            except FileNotFoundError as error:
                raise CheckpointMismatch(
                    f"{source / key} is gone, which the checkpoint builds on"
                ) from error
        self._folder.commit()
        self.rows = self.durable = durable

    def finishing(self) -> Iterator[None]:
        """Write the rows of the last shard, full or not, in two steps.

        The folder is to be committed after each: several tables are finished with one wait.
        """
        if self.rows > self.durable:
            yield from self._writing()

    def shard_keys(self, first: int, stop: int) -> list[str]:
        """Name the files that hold shards `first` to `stop` - 1 of every column."""
        return [
            f"{self.table.key(column.name)}/c/{index}"
            for index in range(first, stop)
            for column in self.table.columns
        ]

    def _write_shard(self) -> None:
        for _ in self._writing():
            self._folder.commit()

    def _writing(self) -> Iterator[None]:
        """Write the next shard of every column, the last one's in a step of its own.

        Readers take that for the sign that all others are there.
        """
        keys = self.shard_keys(*self._next_shard())
        for key, content in zip(keys, self._contents(), strict=True):
            if key == keys[-1]:
                yield
            self._folder.write(key, content)
        yield
        self.durable = self.rows

    def _next_shard(self) -> tuple[int, int]:
        index = self.durable // self._shard_rows
        return index, index + 1

    def _contents(self) -> Iterator[bytes]:
        """Encode the waiting rows as the files of the next shard, in the order of `shard_keys`."""
        for column, rows in zip(self.table.columns, self.pending(), strict=True):
            yield shards.encode(rows, self.table.chunk_rows, self._shard_rows, column.fill)
