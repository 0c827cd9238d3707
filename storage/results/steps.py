"""Accepted steps of a run, from which whoever knows its equations reads any window exactly.

One array of (steps, columns), written as the run grows; a file of it holds all columns of some
steps. What a row means is the solver's business. It is no part of what clients are shown.
"""

import json
from collections.abc import Iterator
from functools import cached_property
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.packed import Files, Running
from jointplay.storage.results import metadata, shards
from jointplay.storage.results.growing_table import GrowingTable
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.metadata import DOUBLE
from jointplay.storage.results.tables import Column, Table
from jointplay.storage.results.waiting import Waiting

GROUP: Final = "steps"
ARRAY: Final = "rows"
ROWS: Final = 8192
"""Steps of a file: what reading a short window decodes."""
PERIOD, TIME, LENGTH = 0, 1, 2
"""Columns that say when a step is: whole periods, the time since then and its length, s."""


class StepsTable(GrowingTable):
    """The array being written.

    Parameters
    ----------
    layout
        Of the store, which names the columns.
    files
        Where its files are written.
    """

    def __init__(self, layout: ResultLayout, files: Running) -> None:
        self._period = layout.steps_period
        columns = tuple(Column(name, DOUBLE, {}) for name in layout.steps)
        super().__init__(Table(GROUP, "step", columns, None, ROWS, ROWS, {}), files)

    def shard_keys(self, index: int) -> list[str]:
        """Name the one file of a shard, which holds all columns."""
        return [f"{self.table.key(ARRAY)}/c/{index}/0"]

    def document(self) -> tuple[str, metadata.Document]:
        """Give key and document of the array, with as many rows as there are by now."""
        names = [column.name for column in self.table.columns]
        return f"{self.table.key(ARRAY)}/{metadata.FILE}", metadata.array(
            [self.rows, len(names)],
            [ROWS, 1],
            DOUBLE,
            ["step", "column"],
            {"long_name": "accepted steps", "columns": names, "period": self._period},
            shard=[ROWS, len(names)],
            compressor=shards.FAST,
        )

    def _contents(self) -> Iterator[bytes]:
        whole = np.full(ROWS, np.nan)
        chunks = []
        for column in self.pending():
            whole[: len(column)] = column
            chunks.append(shards.compress(whole, fast=True))
        yield shards.pack(chunks)


class StoredSteps:
    """The array of one store; make it with `stored_steps`.

    Parameters
    ----------
    files
        Of the store.
    columns
        Names of the columns.
    period
        Of the run, s: what whole periods are of.
    waiting
        Rows in shards, and those that wait for theirs.
    """

    def __init__(
        self, files: Files, columns: tuple[str, ...], period: float, waiting: Waiting
    ) -> None:
        self.columns = columns
        self.period = period
        self._files = files
        self._waiting = waiting
        self._indices: dict[int, list[tuple[int, int]]] = {}

    @property
    def count(self) -> int:
        """Steps that can be read."""
        return self._waiting.rows

    def read(self, first: int, last: int) -> Floats:
        """Read steps [first, last): (last - first, columns)."""
        rows = np.empty((last - first, len(self.columns)))
        for column in range(len(self.columns)):
            self._fill(rows[:, column], column, first)
        return rows

    @cached_property
    def end(self) -> float:
        """Time that the steps reach, s."""
        if not self.count:
            return 0.0
        (last,) = self.read(self.count - 1, self.count)
        return float(last[PERIOD] * self.period + last[TIME] + last[LENGTH])

    def begins(self, steps: Floats) -> Floats:
        """Return when steps (n, columns) begin, s."""
        return np.asarray(steps[:, PERIOD] * self.period + steps[:, TIME])

    def begin(self, step: int) -> float:
        """Return when one step begins, s."""
        return float(self._begins(step, 1)[0])

    def around(self, start: float, stop: float) -> tuple[int, int]:
        """Find the steps [first, last) that a window needs; `stop` must be within the steps."""
        first = max(self._first_behind(start) - 2, 0)  # the step that ends there, too
        return first, max(self._first_behind(stop), first + 1)

    def _first_behind(self, time: float) -> int:
        """Find the first step that begins after a time, s."""
        low, high = 0, -(-self.count // ROWS)  # files
        while low < high:
            middle = (low + high) // 2
            if self._begins(min((middle + 1) * ROWS, self.count) - 1, 1)[0] <= time:
                low = middle + 1
            else:
                high = middle
        first = min(low * ROWS, self.count)
        begins = self._begins(first, min(ROWS, self.count - first))
        return first + int(np.searchsorted(begins, time, side="right"))

    def _begins(self, first: int, count: int) -> Floats:
        columns = np.empty((2, count))
        for row, column in zip(columns, (PERIOD, TIME), strict=True):
            self._fill(row, column, first)
        return np.asarray(columns[0] * self.period + columns[1])

    def _fill(self, target: Floats, column: int, first: int) -> None:
        """Read rows of one column, from `first` on, into (k,)."""
        last, durable = first + len(target), self._waiting.durable
        for file in range(first // ROWS, -(-min(last, durable) // ROWS)):
            begin = file * ROWS
            low, high = max(first, begin), min(last, begin + ROWS, durable)
            target[low - first : high - first] = self._chunk(file, column)[
                low - begin : high - begin
            ]
        if last > durable:
            low = max(first, durable)
            target[low - first :] = self._waiting.columns[column][low - durable : last - durable]

    def _chunk(self, file: int, column: int) -> Floats:
        key = f"{GROUP}/{ARRAY}/c/{file}/0"
        index = self._indices.get(file)
        if index is None:
            size = self._files.entry(key).size
            packed = self._files.read(key, size - shards.index_bytes(len(self.columns)), size)
            index = self._indices[file] = shards.unpack_index(packed)
        offset, length = index[column]
        return shards.decompress(self._files.read(key, offset, offset + length), DOUBLE)


def stored_steps(files: Files, waiting: Waiting | None) -> StoredSteps | None:
    """Return the steps of a store; None where none are kept.

    `waiting` : of a growing store, how many are committed; by default those in its files.
    """
    key = f"{GROUP}/{ARRAY}/{metadata.FILE}"
    try:
        document = json.loads(files.read(key))
    except FileNotFoundError:
        return None
    columns, period = (document["attributes"][name] for name in ("columns", "period"))
    if not isinstance(files, Running):
        waiting = Waiting(int(document["shape"][0]), ())
    known = waiting or Waiting(rows_in_files(files), ())
    return StoredSteps(files, tuple(columns), period, known)


def rows_in_files(files: Files) -> int:
    """Count the steps of a growing store that are in its files."""
    return ROWS * files.shards(f"{GROUP}/{ARRAY}/c/{{}}/0") if isinstance(files, Running) else 0
