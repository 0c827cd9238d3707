"""A study's store at one moment, also while it is filled: its files with the parts laid over."""

import json
import math
from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.coarse_to_fine import order_of
from jointplay.records.point import Failure
from jointplay.records.run import Floats
from jointplay.storage.errors import CheckpointMismatch, CorruptStore, LostObject, NotAStore
from jointplay.storage.packed import Files, Running
from jointplay.storage.packed.running import PARTS
from jointplay.storage.results.metadata import FILE
from jointplay.storage.results.store_reader import StoreReader
from jointplay.storage.studies import part
from jointplay.storage.studies.block import lost, path_of
from jointplay.storage.studies.kept_parts import KEPT_PARTS
from jointplay.storage.studies.layout import STUDY_SCHEMAS, StudyLayout, on_map
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.points import INDICATORS, STATISTICS, Points, together
from jointplay.storage.studies.store import FAILURES, REASONS, RESULTS

_PATIENCE = 100  # times that parts may be replaced while they are being read


class StudySnapshot(StoreReader):
    """One study's store: its attributes and its points, all of one moment.

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
        if schema not in STUDY_SCHEMAS:
            known = " and ".join(map(str, STUDY_SCHEMAS))
            raise NotAStore(f"this has study schema {schema}; this version reads {known}")
        self.complete = bool(self.attributes["complete"])
        """Every point has ended; False while it runs and when it failed or was cancelled."""
        self.points = int(self.attributes["points"])
        self.shape = tuple(int(one) for one in self.attributes.get("shape", (self.points,)))
        """Lengths of the axes of what has one number a point: all points, or (y, x) of a map."""
        self.record = int(self.attributes["record"])
        """Sections that a point records at most."""
        self.parameters = _specs(self.attributes["parameters"])
        self.observables = _specs(self.attributes["observables"])
        self.channels = _specs(self.attributes["channels"])
        self.blocks = tuple((int(first), int(count)) for first, count in self.attributes["blocks"])
        """(first, count) of the points that are computed together."""
        self.__dict__.pop("_root", None)  # its documents were those of the growing store

    @cached_property
    def values(self) -> Floats:
        """(points, parameters), in the units of the parameters."""
        if len(self.shape) == 2:
            return self.layout.values
        columns = [self._array(f"values/{spec.name}")[:] for spec in self.parameters]
        return np.asarray(columns, dtype=np.float64).reshape(len(columns), self.points).T

    @cached_property
    def _parts(self) -> dict[int, Part]:
        """Parts of a store that is not sealed, by block, each of one moment.

        They go when the study is sealed, after the packed store is there: if there is none when
        they have been read, they were all there.
        """
        for _ in range(_PATIENCE):
            if not isinstance(self.files, Running):
                return {}
            digest = self.attributes["layout"]
            try:
                found = {
                    index: KEPT_PARTS.read(self.files, name, digest, self.layout)
                    for index, name in part.newest(self.files.parts()).items()
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
                if not files.has(path_of(key)):
                    return lost(files, index, key)
        return None

    @cached_property
    def written(self) -> frozenset[str]:
        """Indices, such as ``3/0``, of the chunks of sections that are in files by now."""
        return frozenset(
            f"{row}/{column}"
            for one in self._parts.values()
            for row, column in one.written(self.layout)
        )

    @cached_property
    def layout(self) -> StudyLayout:
        """Layout of the store, as far as its arrays are concerned."""
        fields = self.parameters, self.observables, self.record, self.channels, self.blocks
        if len(self.shape) == 2:
            y, x = (np.asarray(self._array(axis)[:], np.float64) for axis in ("y", "x"))
            job = json.dumps(self.attributes.get("job", {}))
            return _layout_of_map(*fields, self.shape, (y.tobytes(), x.tobytes()), job)
        parameters, observables, record, channels, blocks = fields
        return StudyLayout(parameters, self.values, observables, record, channels, blocks)

    @property
    def coordinates(self) -> Mapping[str, tuple[Channel, Floats]]:
        """The parameter along each axis of a map, with its values; none on one axis."""
        return self.layout.coordinates if len(self.shape) == 2 else {}

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
            self._by_point(self._array("status"), np.uint8),
            self._by_point(self._array("count"), np.int32),
            np.empty((0, 0, 4)),
            self._failures(),
            self._reasons(),
            self._documents(),
            {
                f"{group}/{name}": self._by_point(array, np.float64)
                for group, members in groups
                if isinstance(members, zarr.Group)
                for name, array in members.arrays()
                if name not in self.coordinates
            },
        )

    def _by_point(self, array: Any, dtype: type[np.generic]) -> NDArray[Any]:
        """Return an array with a number a point, (points,), in the order of the points."""
        values = np.asarray(array[:], dtype).ravel()
        return values if len(self.shape) == 1 else values[self.layout.order]

    def _failures(self) -> dict[int, Failure]:
        try:
            found = json.loads(self.files.read(FAILURES))
        except FileNotFoundError:
            return {}
        return {
            int(point): Failure(code, detail, math.nan if time is None else time)
            for point, (code, detail, time) in found.items()
        }

    def _reasons(self) -> dict[int, str]:
        try:
            found: dict[str, str] = json.loads(self.files.read(REASONS))
        except FileNotFoundError:
            return {}
        return {int(point): reason for point, reason in found.items()}

    def _documents(self) -> dict[int, Mapping[str, Any]]:
        try:
            found: dict[str, dict[str, Any]] = json.loads(self.files.read(RESULTS))
        except FileNotFoundError:
            return {}
        return {int(point): document for point, document in found.items()}


def _specs(listed: Sequence[Sequence[str]]) -> tuple[Channel, ...]:
    return tuple(Channel(*spec) for spec in listed)


@lru_cache(4)
def _layout_of_map(
    parameters: tuple[Channel, ...],
    observables: tuple[Channel, ...],
    record: int,
    channels: tuple[Channel, ...],
    blocks: tuple[tuple[int, int], ...],
    shape: tuple[int, ...],
    axes: tuple[bytes, bytes],
    job: str,
) -> StudyLayout:
    """Return the layout of a map; of a million points making it takes a quarter of a second."""
    of_map: dict[str, Any] = {"job": json.loads(job)}
    y, x = (np.frombuffer(axis) for axis in axes)
    values = on_map(y, x, order_of(of_map["job"], shape))
    values.flags.writeable = False
    return StudyLayout(
        parameters, values, observables, record, channels, blocks, of_map, shape=shape
    )
