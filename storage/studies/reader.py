"""Read a study's store, also while it is being filled: stock zarr, with the parts laid over it."""

import json
import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.names import TIME
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure
from jointplay.records.run import Floats
from jointplay.storage.errors import (
    CheckpointMismatch,
    CorruptStore,
    LostObject,
    NotAStore,
    UnknownChannel,
)
from jointplay.storage.packed import Files, Running
from jointplay.storage.packed.running import PARTS
from jointplay.storage.results.metadata import FILE
from jointplay.storage.results.store_reader import StoreReader
from jointplay.storage.studies import part
from jointplay.storage.studies.block import lost, place_of
from jointplay.storage.studies.layout import STUDY_SCHEMA, StudyLayout
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.points import INDICATORS, STATISTICS, Points, together
from jointplay.storage.studies.store import FAILURES

_PATIENCE = 100  # times that parts may be replaced while they are being read


class StudyReader(StoreReader):
    """One study's store as it is at this moment: sealed, growing, or left incomplete.

    Opening reads one small file; everything else is read when it is asked for.

    Parameters
    ----------
    source
        Its files, or the path of a packed store or of the folder of one that is being filled.

    Raises
    ------
    NotAStore
        There is no store of a study, or one of a schema that this version does not know.
    """

    def __init__(self, source: Files | Path) -> None:
        super().__init__(source)
        self._open()

    def _open(self) -> None:
        try:
            self.attributes: dict[str, Any] = json.loads(self.files.read(FILE))["attributes"]
            schema = self.attributes.get("study_schema")
        except (FileNotFoundError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise NotAStore("there is no store of a study") from error
        if schema != STUDY_SCHEMA:
            raise NotAStore(f"this has study schema {schema}; this version reads {STUDY_SCHEMA}")
        self.complete = bool(self.attributes["complete"])
        """Every point has ended; False while it runs and when it failed or was cancelled."""
        self.points = int(self.attributes["points"])
        self.record = int(self.attributes["record"])
        """Sections that a point records at most."""
        self.parameters = _specs(self.attributes["parameters"])
        self.observables = _specs(self.attributes["observables"])
        self.channels = _specs(self.attributes["channels"])
        self.blocks = tuple((int(first), int(count)) for first, count in self.attributes["blocks"])
        """(first, count) of the points that are computed together."""
        self.__dict__.pop("_root", None)  # its documents were those of the growing store

    @property
    def kind(self) -> str:
        """Kind of the job."""
        return str(self.attributes["job"]["kind"])

    @cached_property
    def values(self) -> Floats:
        """(points, parameters), in the units of the parameters."""
        columns = [self._array(f"values/{spec.name}")[:] for spec in self.parameters]
        return np.asarray(columns, dtype=np.float64).reshape(len(columns), self.points).T

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
        return PeakColumns(
            *(
                np.asarray(self._array(f"peaks/{name}")[:, column], np.float64)
                for name in PeakColumns._fields
            )
        )

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

    @cached_property
    def _parts(self) -> dict[int, Part]:
        """Parts of a store that is not sealed, by block, each of one moment.

        They go when the study is sealed, after the packed store is there: if there is none when
        they have been read, they were all there.
        """
        for _ in range(_PATIENCE):
            if not isinstance(self.files, Running):
                return {}
            try:
                found = {
                    index: Part.read(path, self.attributes["layout"])
                    for index, path in part.newest(self.files.folder).items()
                }
            except FileNotFoundError:  # one was replaced by the last part of its block
                continue
            except CheckpointMismatch as error:
                raise CorruptStore(str(error)) from error
            missing = self._missing(self.files, found)
            sealed = self.files.sealed()
            if sealed is None and missing is not None:
                raise missing
            if sealed is None:
                return found
            self.files = sealed
            self._open()
        raise NotAStore("the study changes faster than it can be read")

    def _missing(self, files: Running, parts: Mapping[int, Part]) -> LostObject | None:
        """Look for a chunk that a part builds on and that is not there."""
        for index, one in parts.items():
            for key in one.written(self.layout):
                if not files.has(place_of(key)):
                    return lost(files, index, key)
        return None

    @cached_property
    def written(self) -> frozenset[str]:
        """Places, such as ``3/0``, of the chunks of sections that are in files by now."""
        return frozenset(
            f"{row}/{column}"
            for one in self._parts.values()
            for row, column in one.written(self.layout)
        )

    @cached_property
    def layout(self) -> StudyLayout:
        """Layout of the store, as far as its arrays are concerned."""
        return StudyLayout(
            parameters=self.parameters,
            values=self.values,
            observables=self.observables,
            record=self.record,
            channels=self.channels,
            blocks=self.blocks,
        )

    def require(self, ended: Mapping[int, int]) -> None:
        """Compare a growing store with what its blocks were known to have computed.

        Parameters
        ----------
        ended
            Points that had ended, by block, before the store was opened.

        Raises
        ------
        CorruptStore
            The part of a block is gone, or of an earlier moment.
        """
        parts = self._parts
        for index, count in ended.items() if not self.sealed else ():
            found = parts.get(index)
            if found is None or found.ended < count:
                name = f"{PARTS}/{part.final_name(index)}"
                raise LostObject(f"{name}, the part with {count} ended points of a block, is gone")

    @cached_property
    def known(self) -> Points:
        """Arrays with one number a point; peaks only while the store grows."""
        parts = self._parts
        if not self.sealed:
            return together(parts.get, self.blocks, len(self.channels), 0, self.points)
        groups = [(group, self._root.get(group)) for group in (STATISTICS, INDICATORS)]
        return Points(
            np.asarray(self._array("status")[:], np.uint8),
            np.asarray(self._array("count")[:], np.int32),
            np.empty((0, 0, 4)),
            self._failures(),
            {
                f"{group}/{name}": np.asarray(array[:], np.float64)
                for group, members in groups
                if isinstance(members, zarr.Group)
                for name, array in members.arrays()
            },
        )

    def _failures(self) -> dict[int, Failure]:
        try:
            found = json.loads(self.files.read(FAILURES))
        except FileNotFoundError:
            return {}
        return {
            int(point): Failure(code, detail, math.nan if time is None else time)
            for point, (code, detail, time) in found.items()
        }


def _specs(listed: Sequence[Sequence[str]]) -> tuple[Channel, ...]:
    return tuple(Channel(*spec) for spec in listed)


def _position(name: str, specs: Sequence[Channel]) -> int:
    names = tuple(spec.name for spec in specs)
    if name not in names:
        raise UnknownChannel(name, names)
    return names.index(name)


def _overlap(window: slice, begin: int, length: int) -> tuple[slice, slice]:
    """Where a window and a range meet: as slices of the window, and of the range."""
    low = max(window.start, begin)
    high = max(min(window.stop, begin + length), low)
    return slice(low - window.start, high - window.start), slice(low - begin, high - begin)
