"""Tables of many columns that are read together: a file holds all columns of some rows.

One array of (rows, columns). It is no part of what clients are shown.
"""

import json
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.packed import Files, Running
from jointplay.storage.results import metadata, shards
from jointplay.storage.results.growing_table import Columns, GrowingTable
from jointplay.storage.results.metadata import DOUBLE, shape_of
from jointplay.storage.results.stored_columns import StoredColumns
from jointplay.storage.results.tables import Column, Table
from jointplay.storage.results.waiting import Waiting

ARRAY: Final = "rows"


class WideTable(GrowingTable):
    """The array being written.

    Parameters
    ----------
    group
        Where it is in the store.
    columns
        Names of the columns.
    rows
        In a file.
    attributes
        Of the array, besides the names.
    files
        Where its files are written.
    """

    _AT_ONCE = 2  # files are small, and a short run has no more rows: it writes none

    def __init__(
        self,
        group: str,
        columns: tuple[str, ...],
        rows: int,
        attributes: Mapping[str, Any],
        files: Running,
    ) -> None:
        table = Table(group, group[:-1], _named(columns), None, rows, rows, dict(attributes))
        super().__init__(table, files)

    def shard_keys(self, index: int) -> list[str]:
        """Name the one chunk of a shard, which holds all columns."""
        return [f"{self.table.key(ARRAY)}/c/{index}/0"]

    def document(self) -> tuple[str, metadata.Document]:
        """Give key and document of the array, with as many rows as there are by now."""
        names, rows = [column.name for column in self.table.columns], self.table.shard_rows
        attributes = self.table.attributes
        return f"{self.table.key(ARRAY)}/{metadata.FILE}", metadata.array(
            [self.rows, len(names)],
            [rows, 1],
            DOUBLE,
            [self.table.dimension, "column"],
            {"long_name": attributes["long_name"], "columns": names, **attributes},
            shard=[rows, len(names)],
        )

    def _contents(self, columns: Columns) -> Iterator[bytes]:
        whole = np.full(self.table.shard_rows, np.nan)
        chunks = []
        for column in columns:
            whole[: len(column)] = column
            chunks.append(shards.compress(whole))
        yield shards.pack(chunks)


@lru_cache(maxsize=8)
def _named(columns: tuple[str, ...]) -> tuple[Column, ...]:
    return tuple(Column(name, DOUBLE, {}) for name in columns)


class StoredRows:
    """The array of one store.

    Parameters
    ----------
    files
        Of the store.
    group
        Where it is.
    waiting
        Of a growing store, rows in shards, and those that wait for theirs; by default those in its
        files.

    Raises
    ------
    FileNotFoundError
        The store has no such array.
    """

    def __init__(self, files: Files, group: str, waiting: Waiting | None) -> None:
        document = json.loads(files.read(f"{group}/{ARRAY}/{metadata.FILE}"))
        if not isinstance(files, Running):
            waiting = Waiting(int(document["shape"][0]), ())
        self.attributes: dict[str, Any] = document["attributes"]
        self.columns = tuple(self.attributes["columns"])
        rows, _ = shape_of(document)
        self._stored = StoredColumns(files, f"{group}/{ARRAY}", document)
        self._waiting = waiting or Waiting(rows_in_files(files, group, rows), ())

    @property
    def count(self) -> int:
        """Rows that can be read."""
        return self._waiting.rows

    def column(self, column: int, first: int, last: int) -> Floats:
        """Read rows [first, last) of a column."""
        return self._stored.read(first, last, column, self._waiting.column(column))


def rows_in_files(files: Files, group: str, rows: int) -> int:
    """Count the rows of a growing array that are in its files, so many in each."""
    return rows * files.shards(f"{group}/{ARRAY}/c/{{}}/0") if isinstance(files, Running) else 0
