"""Read a study's store, also while it is being filled: what each of its points has."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.names import TIME
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure
from jointplay.records.run import Floats
from jointplay.storage.errors import UnknownChannel
from jointplay.storage.studies.points import INDICATORS, STATISTICS
from jointplay.storage.studies.snapshot import StudySnapshot


class StudyReader(StudySnapshot):
    """One study's store as it is at this moment: sealed, growing, or left incomplete."""

    grounds: Callable[["StudyReader", Iterable[int]], Mapping[int, str]] | None = None
    """Finds the reasons of some points where only numbers are kept; whoever knows how gives it."""

    @property
    def kind(self) -> str:
        """Kind of the job."""
        return str(self.attributes["job"]["kind"])

    @property
    def status(self) -> NDArray[np.uint8]:
        """(points,) codes of `PointStatus`: waiting, running, done, failed."""
        return self.known.status

    @property
    def counts(self) -> NDArray[np.int64]:
        """(points,) sections recorded so far."""
        return self.known.counts.astype(np.int64)

    @property
    def failures(self) -> Mapping[int, Failure]:
        """Failed points: code, sentence, simulated time reached."""
        return self.known.failures

    @property
    def statistics(self) -> Mapping[str, Floats]:
        """(points,) by name; NaN at points that have not ended."""
        return self.known.group(STATISTICS)

    @property
    def indicators(self) -> Mapping[str, Floats]:
        """(points,) by name; NaN at points that have not ended."""
        return self.known.group(INDICATORS)

    @property
    def own_outputs(self) -> Mapping[str, tuple[str, str]]:
        """Unit and long name of statistics that this study has and others need not, by name."""
        found: dict[str, list[str]] = self.attributes.get("meanings", {})
        return {name: (unit, long_name) for name, (unit, long_name) in found.items()}

    @property
    def verdicts(self) -> NDArray[np.int64] | None:
        """(points,) codes into `verdict_names`, -1 where there is none yet; None: not asked for."""
        found = self.indicators.get("verdict")
        if found is None:
            return None
        return np.where(np.isnan(found), -1, np.nan_to_num(found)).astype(np.int64)

    @property
    def verdict_names(self) -> Sequence[str]:
        """Names of the verdicts."""
        return tuple(self.attributes.get("verdicts", ()))

    @property
    def reasons(self) -> Mapping[int, str]:
        """Grounds of verdicts, by point."""
        kept = self.known.reasons
        if kept or self.grounds is None:
            return kept
        return self.grounds(self, range(self.points))

    @property
    def documents(self) -> Mapping[int, Mapping[str, Any]]:
        """Results that are no numbers, by point: of a calibration what it found."""
        return self.known.documents

    def peaks(self, channel: str) -> PeakColumns:
        """Give the extremes of a channel at every point; NaN at points that have not ended.

        Raises
        ------
        UnknownChannel
            Peaks of this channel are not kept.
        """
        column = _position(channel, self.channels)
        known = self.known
        if not self.sealed:
            return PeakColumns(*known.peaks[:, column, :].T)
        arrays = (self._array(f"peaks/{name}")[..., column] for name in PeakColumns._fields)
        return PeakColumns(*(self._by_point(values, np.float64) for values in arrays))

    def section_times(self, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) times [s] of the sections of points, NaN-filled."""
        return self._sections(TIME, len(self.observables), start, stop)

    def sections(self, observable: str, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) values of an observable at points, NaN-filled.

        Raises
        ------
        UnknownChannel
            The observable was not recorded.
        """
        column = _position(observable, self.observables)
        return self._sections(observable, column, start, stop)

    def point_sections(
        self,
        point: int,
        observables: Sequence[str] | None = None,
        first: int = 0,
        stop: int | None = None,
    ) -> tuple[Floats, dict[str, Floats]]:
        """Give sections `first` to `stop` - 1 of one point, as far as they were recorded.

        Memory is bounded by the window: a million sections can be read piece by piece.

        Returns
        -------
        tuple
            (k,) times [s] and by observable (default: all) (k,) values.

        Raises
        ------
        UnknownChannel
            An observable was not recorded.
        """
        names = [spec.name for spec in self.observables] if observables is None else observables
        positions = {name: _position(name, self.observables) for name in names}
        recorded = int(self.counts[point])
        window = slice(max(first, 0), recorded if stop is None else max(min(stop, recorded), 0))
        columns = {
            name: self._window(name, column, slice(point, point + 1), window)[0]
            for name, column in {TIME: len(self.observables), **positions}.items()
        }
        return columns.pop(TIME), columns

    def _sections(self, name: str, column: int, start: int, stop: int | None) -> Floats:
        points = slice(*slice(start, stop).indices(self.points))
        return self._window(name, column, points, slice(0, self.record))

    def _window(self, name: str, column: int, points: slice, sections: slice) -> Floats:
        """Read from the array, then lay what no chunk holds yet over it."""
        if not self.record:
            return np.empty((max(points.stop - points.start, 0), 0))
        parts = self._parts  # before the array: what has left them is in it by then
        array = self._array(f"sections/{name}")
        found = np.array(array[points, sections], dtype=np.float64)
        height, width = array.chunks
        for known in parts.values():
            for (row, section), chunk in known.open.items():
                inside, of_chunk = _overlap(points, row * height, chunk.shape[1])
                within, of_row = _overlap(sections, section * width, chunk.shape[2])
                new = chunk[column][of_chunk, of_row]
                np.copyto(found[inside, within], new, where=~np.isnan(new))
        return found


def _position(name: str, specs: Sequence[Channel]) -> int:
    names = tuple(spec.name for spec in specs)
    if name not in names:
        raise UnknownChannel(name, names)
    return names.index(name)


def _overlap(window: slice, begin: int, length: int) -> tuple[slice, slice]:
    """Give the overlap of a window and a range: as slices of the window, and of the range."""
    low = max(window.start, begin)
    high = max(min(window.stop, begin + length), low)
    return slice(low - window.start, high - window.start), slice(low - begin, high - begin)
