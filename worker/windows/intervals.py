"""Extremes of windows where a run has no steps: those of the intervals between its samples."""

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.storage.results.intervals import StoredIntervals
from jointplay.storage.results.reader import ResultReader

EDGE = 1e-9
"""Share of an interval by which a window may go beyond it: rounding of its times."""
INSIDE = 1e-6
"""Share of what a channel does in an interval by which an extreme is beyond both its samples."""


class Intervals:
    """Intervals of one run, from the time that its steps reach.

    Parameters
    ----------
    reader
        Of the run.
    stored
        Its intervals.
    begin
        Time at which the first begins, s.
    """

    def __init__(self, reader: ResultReader, stored: StoredIntervals, begin: float) -> None:
        self._reader, self._stored, self.begin = reader, stored, begin
        self.behind = min(stored.first + stored.count, reader.samples)
        """Sample behind the last that ends an interval."""

    def ends(self, start: float, stop: float) -> tuple[int, Floats]:
        """Return the first interval that a window needs, and times: its begin, s, and all ends."""
        first, last = self._reader.between(start, stop)
        first = min(max(first, self._stored.first), self.behind - 1)
        last = min(max(last + 1, first + 1), self.behind)
        before = max(first - 1, 0)
        times = self._reader.history([], before, last)[0][first - before - 1 :]
        if first == self._stored.first:
            times = np.append(self.begin, times[-(last - first) :])
        slack = EDGE * (times[1] - times[0])
        skipped = int(len(times) > 2 and times[1] <= start + slack)
        behind = len(times) - int(len(times) > skipped + 2 and times[-2] >= stop - slack)
        return first + skipped, times[skipped:behind]

    def extremes(self, names: tuple[str, ...], edges: Floats) -> Floats:
        """Return extremes (bins, names, 4) of all intervals that a bin has a part of.

        Lowest, its time, highest, its time; NaN of a bin without an interval.  An extreme that is
        not at a sample is said to be in the middle of its interval.
        """
        first, times = self.ends(float(edges[0]), float(edges[-1]))
        last = first + len(times) - 1
        slack = EDGE * np.diff(times).max()
        begin = np.searchsorted(times[1:], edges[:-1] + slack, side="right")
        end = np.searchsorted(times[:-1], edges[1:] - slack, side="left")
        end = np.minimum(np.where(edges[1:] > edges[:-1], end, begin + 1), len(times) - 1)
        found = np.full((len(begin), len(names), 4), np.nan)
        chosen = end > begin
        if not chosen.any():
            return found
        columns = self._reader.history(names, max(first - 1, 0), last)[1]
        for c, name in enumerate(names):
            samples = columns[name][-len(times) :]
            pairs = self._stored.read(name, first, last)
            for sense, k in ((1.0, 0), (-1.0, 1)):
                instants = _instants(
                    sense * samples, sense * pairs[:, k], np.ptp(pairs, axis=1), times
                )
                best = _lowest(sense * pairs[:, k], begin[chosen], end[chosen])
                found[chosen, c, 2 * k] = pairs[best, k]
                found[chosen, c, 2 * k + 1] = instants[best]
        return found


def _lowest(values: Floats, begin: NDArray[np.intp], end: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return where the smallest of values [begin, end) is, for each of such ranges."""
    counts = end - begin
    offsets = np.cumsum(counts) - counts
    flat = np.repeat(begin - offsets, counts) + np.arange(counts.sum())
    least = np.repeat(np.fmin.reduceat(values[flat], offsets), counts)
    return np.asarray(np.minimum.reduceat(np.where(values[flat] > least, end[-1], flat), offsets))


def _instants(samples: Floats, least: Floats, wide: Floats, times: Floats) -> Floats:
    """Return when intervals (k,) are lowest, s: at the lower sample, unless it is lower inside."""
    before, after = samples[:-1], samples[1:]
    middle = 0.5 * (times[:-1] + times[1:])
    ends = np.where(before < after, times[:-1], times[1:])
    return np.where(least < np.minimum(before, after) - INSIDE * wide, middle, ends)
