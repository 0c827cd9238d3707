"""Smallest and largest values of channels from each sample to the next, where steps are not kept.

Rows are of consecutive intervals up to the last: the first begins where steps end.
"""

from collections.abc import Iterable
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.packed import Files, Running
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.waiting import Waiting
from jointplay.storage.results.wide_table import StoredRows, WideTable

GROUP: Final = "intervals"
ROWS: Final = 1024
"""Intervals of a file."""
SAMPLE: Final = "sample"
"""First column: index of the sample at the end of the interval."""


def columns(channels: Iterable[str]) -> tuple[str, ...]:
    """Return the columns of a run with some channels."""
    return SAMPLE, *(f"{name} {extreme}" for name in channels for extreme in ("minimum", "maximum"))


def intervals_table(layout: ResultLayout, files: Running) -> WideTable:
    """Return the table of a layout's intervals, to be written."""
    names = columns(channel.name for channel in layout.channels)
    return WideTable(GROUP, names, ROWS, {"long_name": "extremes between samples"}, files)


class StoredIntervals(StoredRows):
    """The intervals of one store; see `StoredRows`."""

    def __init__(self, files: Files, waiting: Waiting | None) -> None:
        super().__init__(files, GROUP, waiting)
        self.first = int(self.column(0, 0, 1)[0]) if self.count else 0
        """Sample at the end of the first."""

    def read(self, name: str, first: int, last: int) -> Floats:
        """Read extremes (last - first, 2) of a channel in the intervals that end with samples."""
        position = self.columns.index(f"{name} minimum")
        rows = first - self.first, last - self.first
        return np.column_stack([self.column(position + k, *rows) for k in (0, 1)])


def stored_intervals(files: Files, waiting: Waiting | None) -> StoredIntervals | None:
    """Return the intervals of a store; None where there are none."""
    try:
        found = StoredIntervals(files, waiting)
    except FileNotFoundError:
        return None
    return found if found.count else None
