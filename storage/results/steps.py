"""Accepted steps of a run, from which whoever knows its equations reads any window exactly.

What a row means is the solver's business.
"""

from functools import cached_property
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.packed import Files, Running
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.waiting import Waiting
from jointplay.storage.results.wide_table import StoredRows, WideTable

GROUP: Final = "steps"
ROWS: Final = 8192
"""Steps of a file: what reading a short window decodes."""
PERIOD, TIME, LENGTH = 0, 1, 2
"""Columns that say when a step is: whole periods, the time since then and its length, s."""


def steps_table(layout: ResultLayout, files: Running) -> WideTable:
    """Return the table of a layout's steps, to be written."""
    about = {"long_name": "accepted steps", "period": layout.steps_period}
    return WideTable(GROUP, layout.steps, ROWS, about, files)


class StoredSteps(StoredRows):
    """The steps of one store; see `StoredRows`."""

    def __init__(self, files: Files, waiting: Waiting | None) -> None:
        super().__init__(files, GROUP, waiting)
        self.period = float(self.attributes["period"])
        """Period of the run, s, which windows of whole periods count in."""

    def read(self, first: int, last: int) -> Floats:
        """Read steps [first, last): (last - first, columns)."""
        rows = np.empty((last - first, len(self.columns)))
        for column in range(len(self.columns)):
            rows[:, column] = self.column(column, first, last)
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
        periods, times = (self.column(k, first, first + count) for k in (PERIOD, TIME))
        return np.asarray(periods * self.period + times)


def stored_steps(files: Files, waiting: Waiting | None) -> StoredSteps | None:
    """Return the steps of a store; None where none are kept."""
    try:
        return StoredSteps(files, waiting)
    except FileNotFoundError:
        return None
