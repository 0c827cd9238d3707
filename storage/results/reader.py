"""Read a results store, also while it is being written."""

from collections.abc import Iterator, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from jointplay.records.between_samples import BetweenSamples
from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.names import TIME
from jointplay.records.peak import PEAK, Peak
from jointplay.records.run import CertificateRecord, Columns, Floats
from jointplay.storage.errors import UnknownChannel
from jointplay.storage.packed import Files, Running
from jointplay.storage.results import certificate_group
from jointplay.storage.results.envelope import Envelope
from jointplay.storage.results.intervals import GROUP as INTERVALS
from jointplay.storage.results.intervals import StoredIntervals, stored_intervals
from jointplay.storage.results.live import columns_of, committed, root_of, rows_in_shards
from jointplay.storage.results.metadata import Document
from jointplay.storage.results.steps import GROUP as STEPS
from jointplay.storage.results.steps import StoredSteps, stored_steps
from jointplay.storage.results.store_reader import StoreReader
from jointplay.storage.results.stored_columns import StoredColumns
from jointplay.storage.results.waiting import Waiting


class ResultReader(StoreReader):
    """One store, sealed or growing.

    Parameters
    ----------
    source
        Its files, or the path of a packed store or of the folder of a growing one.
    watermark
        Samples that may be read while the store grows: those of a checkpoint, of which some may
        wait for their shard, or fewer than are in shards. By default those in shards. A sealed
        store shows all it has.

    Raises
    ------
    NotAStore
        There is no store, or one of a schema that this version does not know.
    """

    trajectory: BetweenSamples | None = None
    """Reads the run between its samples, if whoever opened it knows how; see `steps`."""

    def __init__(self, source: Files | Path, watermark: int | None = None) -> None:
        super().__init__(source)
        self._document = root = root_of(self.files)
        self.attributes: dict[str, Any] = root["attributes"]
        self._members: dict[str, Document] = root["consolidated_metadata"]["metadata"]
        self.complete = bool(self.attributes["complete"])
        """The run came to its end; False while it runs and when it failed or was cancelled."""
        self.joints: tuple[str, ...] = tuple(self.attributes["joints"])
        """Names that the `joint` of an impact points to."""
        self._waiting: dict[str, Waiting] = {}
        if watermark is not None and isinstance(self.files, Running):
            self._waiting = committed(self.files, watermark, root)
        self.samples = self._rows("")
        """Samples that can be read."""

    @cached_property
    def channels(self) -> tuple[Channel, ...]:
        """Channels in the order of the layout, with units and long names."""
        names = self.attributes["channels"]
        attributes = {name: self._members[name]["attributes"] for name in names}
        return tuple(
            Channel(name, str(found["units"]), str(found["long_name"]))
            for name, found in attributes.items()
        )

    def history(
        self, channels: Sequence[str] | None = None, start: int = 0, stop: int | None = None
    ) -> Columns:
        """Read samples `start` to `stop` - 1 of some channels (default: all, to the end).

        Returns
        -------
        tuple
            (k,) times [s] and by channel (k,) values in its unit; k = 0 for an empty window.

        Raises
        ------
        UnknownChannel
            The store has no such channel.
        """
        return self._read("", channels, *self._window(start, stop))

    def blocks(
        self, channels: Sequence[str] | None = None, start: int = 0, stop: int | None = None
    ) -> Iterator[Columns]:
        """As `history`, in consecutive pieces of at most one chunk, in bounded memory."""
        names = self._names(channels)
        start, stop = self._window(start, stop)
        rows = self._stored("", TIME).chunk_rows
        while start < stop:
            end = min(start - start % rows + rows, stop)
            yield self._read("", names, start, end)
            start = end

    def extremes(
        self, channels: Sequence[str] | None, start: int, stop: int, points: int
    ) -> Columns:
        """Find smallest and largest values of samples `start` to `stop` - 1 in bins.

        Exact: no sample is left out. Long histories have them ready in their pyramid.

        Parameters
        ----------
        channels
            Names; all by default.
        start, stop
            Window of samples, as for `history`.
        points
            Most bins.

        Returns
        -------
        tuple
            (k, 2) times [s] of the first and the last sample of each bin, and by channel (k, 2)
            minima and maxima; k <= `points`.

        Raises
        ------
        UnknownChannel
            The store has no such channel.
        """
        names = self._names(channels)
        start, stop = self._window(start, stop)
        if start >= stop:
            return np.empty((0, 2)), {name: np.empty((0, 2)) for name in names}
        bins = self._envelope.bins(start, stop, points)
        order = columns_of(self.attributes)[""]
        found = {
            name: bins.extremes(order.index(name), partial(self._column, "", name))
            for name in (TIME, *names)
        }
        return found.pop(TIME), found

    def between(self, start: float | None, stop: float | None) -> tuple[int, int]:
        """Find the samples [first, last) of start <= time <= stop [s]; None is unbounded.

        Times must ascend, as those of a simulation do.
        """
        first = 0 if start is None else self._first_sample_from(start, after=False)
        last = self.samples if stop is None else self._first_sample_from(stop, after=True)
        return first, max(first, last)

    def sections(self, channels: Sequence[str] | None = None) -> Columns:
        """Read the Poincare sections: (m,) times [s] and by channel (m,) values."""
        return self._read("poincare", channels, 0, self._rows("poincare"))

    def impacts(self, start: int = 0, stop: int | None = None) -> NDArray[Any]:
        """Read impacts, in order of release, as (j,) structured array of dtype `IMPACT`."""
        total = self._rows("impacts")
        first, last, _ = slice(start, stop).indices(total)
        columns = {
            name: self._column("impacts", name, first, max(first, last))
            for name in IMPACT.names or ()
        }
        rows = np.empty(len(columns["joint"]), IMPACT)
        for name, column in columns.items():
            rows[name] = column
        return rows

    def peaks(self) -> dict[str, Peak]:
        """Read the signed extremes by channel; none before the store is sealed."""
        if not self.sealed:
            return {}
        group = self._group("peaks")
        columns = [np.asarray(group[name]).tolist() for name in PEAK]
        return {
            name: Peak(*values)
            for name, *values in zip(self.attributes["channels"], *columns, strict=True)
        }

    def certificate(self) -> CertificateRecord | None:
        """Read what is known of the rows' errors; none before the store is sealed, or at all."""
        return certificate_group.read(self._root) if self.sealed else None

    @cached_property
    def steps(self) -> StoredSteps | None:
        """Accepted steps, from which any window can be computed exactly; None: not kept."""
        return stored_steps(self.files, self._waiting.get(STEPS))

    @cached_property
    def intervals(self) -> StoredIntervals | None:
        """Extremes between samples, where steps are not kept; None: there are no such samples."""
        return stored_intervals(self.files, self._waiting.get(INTERVALS))

    def _rows(self, group: str) -> int:
        """Rows of a table that are there: all once sealed, else those committed or in shards."""
        if group in self._waiting:
            return self._waiting[group].rows
        if isinstance(self.files, Running):
            return rows_in_shards(self.files, self._document, group)
        last = columns_of(self.attributes)[group][-1]
        return int(self._members[f"{group}/{last}".lstrip("/")]["shape"][0])

    def _window(self, start: int, stop: int | None) -> tuple[int, int]:
        stop = self.samples if stop is None else min(stop, self.samples)
        return max(start, 0), max(stop, 0)

    def _first_sample_from(self, time: float, *, after: bool) -> int:
        """First sample whose time is not below (`after`: above) the given one [s]."""
        side: Literal["left", "right"] = "right" if after else "left"
        if self._last_times is not None:
            size, last_times = self._last_times
            first = min(int(np.searchsorted(last_times, time, side)) * size, self.samples)
            found = self._column("", TIME, first, min(first + size, self.samples))
            return first + int(np.searchsorted(found, time, side))
        rows = self._stored("", TIME).chunk_rows
        low, high = 0, -(-self.samples // rows)  # chunks
        while low < high:
            middle = (low + high) // 2
            at = min((middle + 1) * rows, self.samples) - 1
            last = float(self._column("", TIME, at, at + 1)[0])
            if last < time or (after and last == time):
                low = middle + 1
            else:
                high = middle
        first = min(low * rows, self.samples)
        chunk = self._column("", TIME, first, min(first + rows, self.samples))
        return first + int(np.searchsorted(chunk, time, side))

    @cached_property
    def _envelope(self) -> Envelope:
        return Envelope(self.files, self.samples if self.sealed else None)

    @cached_property
    def _last_times(self) -> tuple[int, Floats] | None:
        """Samples of a bucket, and the last time [s] of each: where a time is to be looked for."""
        rows = self._stored("", TIME).chunk_rows
        levels = [level for level in self._envelope.levels if level.size <= rows]
        if not self.sealed or not levels:
            return None
        column = len(self.attributes["channels"])
        return levels[-1].size, levels[-1].read(column, 0, levels[-1].buckets)[:, 1].copy()

    def _read(self, group: str, channels: Sequence[str] | None, start: int, stop: int) -> Columns:
        names = self._names(channels)
        stop = max(start, stop)
        time = self._column(group, TIME, start, stop)
        return time, {name: self._column(group, name, start, stop) for name in names}

    def _column(self, group: str, name: str, start: int, stop: int) -> NDArray[Any]:
        """Read rows of one array: from shards, then from those that wait for theirs."""
        stored, waiting = self._stored(group, name), self._waiting.get(group)
        if waiting is None or not waiting.columns:
            return stored.read(start, stop)
        column = columns_of(self.attributes)[group].index(name)
        return stored.read(start, stop, tail=waiting.column(column))

    def _stored(self, group: str, name: str) -> StoredColumns:
        path = f"{group}/{name}" if group else name
        return StoredColumns(self.files, path, self._members[path])

    def _names(self, channels: Sequence[str] | None) -> tuple[str, ...]:
        known = tuple(self.attributes["channels"])
        for name in channels or ():
            if name not in known:
                raise UnknownChannel(name, known)
        return known if channels is None else tuple(channels)
