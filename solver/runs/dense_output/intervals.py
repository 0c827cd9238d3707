"""Extremes of channels from each sample to the next, of a run that does not keep its steps."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import HIGHEST, LOWEST
from jointplay.solver.kernels.emit.slots import LENGTH
from jointplay.solver.kernels.loop.entry_points import extremes_in_steps
from jointplay.solver.kernels.loop.extremes.search.brackets import SHARP
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.dense_output.parts import cut
from jointplay.solver.runs.dense_output.replay import Replay

NONE = -1


class IntervalExtremes:
    """Smallest and largest values between samples, whose bits do not depend on slices.

    Parameters
    ----------
    admission, method
        As `Replay` takes them.
    """

    def __init__(self, admission: Admission, method: str) -> None:
        job, names = admission.job, [channel.name for channel in admission.channels]
        self._replay = Replay(admission, method)
        self._last = admission.samples - 1
        self._spacing, self._duration = float(job["output_step"]), float(job["duration"])
        self._sources, self._wanted = self._replay.sought(names)
        self._columns = [self._wanted.index(name) for name, _, _ in self._sources]
        self._factors, self._offsets = np.array([source[1:] for source in self._sources]).T
        self._rows = self._replay.rows(self._wanted)
        self._present = NONE
        """Sample at the end of the interval that is not complete yet."""
        self._book = self._replay.book(self._wanted, np.zeros(len(self._wanted)))

    def go_on_with(self, admission: Admission, method: str) -> None:
        """Take steps of another method from here on."""
        self._replay = Replay(admission, method)

    def add(self, steps: Floats) -> Floats:
        """Return the intervals (k, 1 + 2 channels) that further steps (n, width) complete.

        Index of the sample at the end, then smallest and largest value of each channel in turn.
        """
        if not len(steps):
            return self._arranged(np.empty((0, len(self._wanted), 4)), 0)
        begins, lengths = self._replay.begins(steps), steps[:, LENGTH]
        first, edges = self._edges(float(begins[0]), float(begins[-1] + lengths[-1]))
        goes_on = int(first > self._present != NONE)
        records = np.full((goes_on + len(edges) - 1, len(self._wanted), 4), np.nan)
        parts, shares = cut(begins, lengths, edges)
        parts[:, 1] += goes_on
        extremes_in_steps(
            self._replay.workspace,
            np.ascontiguousarray(steps),
            parts,
            shares,
            self._rows,
            SHARP,
            self._book,
            records,
        )
        self._present = first + len(edges) - 2
        return self._arranged(records[:-1], self._present)

    def end(self) -> Floats:
        """Return the last interval, as `add` does: no step will follow."""
        present, self._present = self._present, NONE
        count = int(present != NONE)
        return self._arranged(self._book[:, self._rows].T[None][:count], present + count)

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return what the next call depends on, as arrays of a checkpoint."""
        return {f"{name}/present": np.array(self._present), f"{name}/book": self._book.copy()}

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        self._present = int(saved[f"{name}/present"])
        self._book = saved[f"{name}/book"].copy()

    def _edges(self, begin: float, end: float) -> tuple[int, Floats]:
        """Return the first sample behind a time, s, and the edges of intervals to another time."""
        low = max(math.floor(begin / self._spacing) - 1, 0)
        high = min(math.ceil(end / self._spacing) + 1, self._last)
        times = np.arange(low, high + 1) * self._spacing
        if high == self._last:
            times[-1] = self._duration
        first = min(int(np.searchsorted(times, begin, side="right")), len(times) - 1)
        behind = min(int(np.searchsorted(times, end)), len(times) - 1)
        return low + first, np.append(begin, times[first : behind + 1])

    def _arranged(self, found: Floats, behind: int) -> Floats:
        """Return records (k, rows, 4) of intervals, up to before that of a sample, by channel."""
        rows = np.empty((len(found), 1 + 2 * len(self._sources)))
        rows[:, 0] = np.arange(behind - len(found), behind)
        for column, line in ((1, LOWEST), (2, HIGHEST)):
            rows[:, column::2] = self._factors * found[:, self._columns, line] + self._offsets
        turned = 1 + 2 * np.flatnonzero(self._factors < 0.0)
        rows[:, turned], rows[:, turned + 1] = rows[:, turned + 1], rows[:, turned]
        return rows
