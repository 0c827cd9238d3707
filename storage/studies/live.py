"""A study's store as stock Zarr clients may see it while it is being filled.

Finished chunks are served as they are; here is made what only the sealed store has: the documents
of all arrays, and the chunks of what is still in the parts of blocks.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.coarse_to_fine import over_axes
from jointplay.records.names import TIME
from jointplay.storage.results import shards
from jointplay.storage.results.metadata import FILE, serialise
from jointplay.storage.studies import documents
from jointplay.storage.studies.points import failure_codes, ordered
from jointplay.storage.studies.reader import StudyReader


class LiveStudy:
    """A study at one moment.

    Parameters
    ----------
    reader
        Of the store.
    outputs
        Units and long names of statistics and indicators that any study may have.
    """

    def __init__(self, reader: StudyReader, outputs: Mapping[str, Channel]) -> None:
        self.files = reader.files
        self._reader = reader
        self._layout = replace(
            reader.layout,
            outputs={
                **outputs,
                **{name: Channel(name, *output) for name, output in reader.own_outputs.items()},
            },
        )
        self.attributes = reader.attributes
        codes = failure_codes(reader.failures)
        names = ordered(reader.known.numbers)
        self._scalars = reader.known.scalars(0, names, codes)
        self._documents = documents.sealed(self._layout, names, {})
        attributes = {**reader.attributes, "failures": ["", *codes]}
        self._documents[FILE] = {**self._documents[FILE], "attributes": attributes}

    def document(self, key: str) -> bytes | None:
        """Give a zarr.json, or None where there is no group or array."""
        found = self._documents.get(key)
        return None if found is None else serialise(found)

    def in_file(self, key: str) -> bool:
        """Whether a chunk was written, so that its file must be there."""
        path, _, index = key.partition("/c/")
        of_sections = path.startswith("sections/") and not self._reader.sealed
        return of_sections and index in self._reader.written

    def chunk(self, key: str) -> bytes | None:
        """Make the file of a chunk, or None if no array has it."""
        path, _, index = key.rpartition("/c/")
        array = self._documents.get(f"{path}/{FILE}")
        if array is None or array["node_type"] != "array" or not index:
            return None
        cell = [int(one) for one in index.split("/")]
        shape: list[int] = array["shape"]
        chunk: list[int] = array["chunk_grid"]["configuration"]["chunk_shape"]
        if len(cell) != len(shape):
            return None
        begin = [nth * size for nth, size in zip(cell, chunk, strict=True)]
        if any(first >= size for first, size in zip(begin, shape, strict=True)):
            return None
        dtype = np.dtype(array["data_type"])
        ends = [
            min(first + size, most) for first, size, most in zip(begin, chunk, shape, strict=True)
        ]
        inside = [slice(*window) for window in zip(begin, ends, strict=True)]
        rows = self._rows(path, inside[0], shape)[(slice(None), *inside[1:])]
        return shards.compress(shards.filled(np.asarray(rows, dtype), chunk))

    def _rows(self, path: str, rows: slice, shape: Sequence[int]) -> NDArray[Any]:
        """Values of an array at a range of its first axis."""
        axis = path.rpartition("/")[2]
        if len(shape) == 1 and axis in self._layout.coordinates:
            return self._layout.coordinates[axis][1][rows]
        if not self._layout.coordinates or path.startswith("sections/"):
            return self._points(path, rows)
        points = self._points(path, slice(0, self._layout.points))
        return over_axes(points, self._layout.order, self._layout.shape)[rows]

    def _points(self, path: str, points: slice) -> NDArray[Any]:
        """Values of an array at a range of points."""
        group, _, name = path.rpartition("/")
        reader = self._reader
        if group == "sections" and name == TIME:
            return reader.section_times(points.start, points.stop)
        if group == "sections":
            return reader.sections(name, points.start, points.stop)
        if group == "values":
            return reader.values[points, [spec.name for spec in reader.parameters].index(name)]
        if group == "peaks":
            columns = [getattr(reader.peaks(channel.name), name) for channel in reader.channels]
            return np.stack(columns, axis=1)[points]
        return self._scalars[path][points]
