"""Extremes of a history over bins of samples: from its pyramid, at the ends from samples."""

import json
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.storage.packed import Files, Running
from jointplay.storage.results import shards
from jointplay.storage.results.metadata import DOUBLE, FILE
from jointplay.storage.results.pyramid import ARRAY, GROUP

Column = Callable[[int, int], Floats]
"""Samples [first, last) of one column."""

_LEAST: Final = 4
"""Buckets of a bin: with fewer, bins that begin with a bucket would be much too wide."""


class StoredLevel:
    """One level of a stored pyramid.

    Parameters
    ----------
    files
        Of the store.
    size
        Samples of a bucket.
    samples
        Of the history; none while it grows.
    """

    def __init__(self, files: Files, size: int, samples: int | None) -> None:
        self.size = size
        self._files = files
        self._path = f"{GROUP}/{size}/{ARRAY}"
        document = json.loads(files.read(f"{self._path}/{FILE}"))
        self._rows, self._width = document["chunk_grid"]["configuration"]["chunk_shape"]
        self._samples = samples
        self._indices: dict[int, list[tuple[int, int]]] = {}

    @property
    def buckets(self) -> int:
        """Buckets that can be read."""
        if self._samples is not None or not isinstance(self._files, Running):
            return -(-(self._samples or 0) // self.size)
        return self._files.shards(f"{self._path}/c/{{}}/0") * int(self._rows)

    def read(self, column: int, first: int, last: int) -> Floats:
        """Read (last - first, 2) minima and maxima of a column in buckets [first, last)."""
        pieces = []
        for file in range(first // self._rows, -(-last // self._rows)):
            begin = file * self._rows
            low, high = max(first - begin, 0), min(last - begin, self._rows)
            pieces.append(self._chunk(file, column)[low:high])
        return np.concatenate(pieces) if pieces else np.empty((0, 2))

    def _chunk(self, file: int, column: int) -> Floats:
        key = f"{self._path}/c/{file}/0"
        index = self._indices.get(file)
        if index is None:
            size = self._files.entry(key).size
            packed = self._files.read(key, size - shards.index_bytes(self._width // 2), size)
            index = self._indices[file] = shards.unpack_index(packed)
        offset, length = index[column]
        content = self._files.read(key, offset, offset + length)
        return shards.decompress(content, DOUBLE, 2 * self._rows).reshape(-1, 2)


class Envelope:
    """Extremes of one store's history.

    Parameters
    ----------
    files
        Of the store.
    samples
        Of the history; none while it grows.
    """

    def __init__(self, files: Files, samples: int | None) -> None:
        found = (key.split("/") for key in files if key.endswith(f"{ARRAY}/{FILE}"))
        sizes = sorted(int(size) for group, size, *_ in found if group == GROUP)
        self.levels = [StoredLevel(files, size, samples) for size in sizes]

    def bins(self, first: int, last: int, points: int) -> "Bins":
        """Cut samples [first, last) into at most `points` bins, which begin with buckets."""
        count = last - first
        width = -(-count // max(points - 1, 1)) if points > 1 else 2 * last
        position = -1
        for candidate, level in enumerate(self.levels):
            if level.size * _LEAST <= width and level.size * 2 <= count:
                position = candidate
        step = self.levels[position].size if position >= 0 else 1
        width = max(-(-width // step) * step, 1)
        inner = np.arange((first // width + 1) * width, last, width)
        return Bins(self, position, step, first, last, np.array([first, *inner]))

    def buckets(self, position: int, column: int, samples: Column, first: int, last: int) -> Floats:
        """Read buckets [first, last) of a level; what it lacks comes from the level below."""
        if position < 0:
            values = samples(first, last)
            return np.column_stack([values, values])
        level = self.levels[position]
        known = min(max(level.buckets, first), last)
        stored = level.read(column, first, known)
        if known == last:
            return stored
        below = self.levels[position - 1].size if position else 1
        factor = level.size // below
        rest = self.buckets(position - 1, column, samples, known * factor, last * factor)
        return np.concatenate([stored, _extremes(rest, np.arange(0, len(rest), factor))])


class Bins:
    """Consecutive bins of samples; make them with `Envelope.bins`."""

    def __init__(
        self,
        envelope: Envelope,
        position: int,
        step: int,
        first: int,
        last: int,
        begins: NDArray[np.int64],
    ) -> None:
        self._envelope, self._position, self._step = envelope, position, step
        self._first, self._last = first, last
        self.begins = begins
        """(k,) first sample of each bin."""

    def extremes(self, column: int, samples: Column) -> Floats:
        """Give (k, 2) minima and maxima of a column, by its position in the store."""
        step = self._step
        low = min(-(-self._first // step) * step, self._last)
        high = max(self._last // step * step, low)
        pieces = [
            self._ends(samples, self._first, low),
            self._envelope.buckets(self._position, column, samples, low // step, high // step)
            if high > low
            else np.empty((0, 2)),
            self._ends(samples, high, self._last),
        ]
        inside = (self.begins - low) // step + len(pieces[0])
        inside[0] = 0
        return _extremes(np.concatenate(pieces), inside)

    @staticmethod
    def _ends(samples: Column, first: int, last: int) -> Floats:
        if first >= last:
            return np.empty((0, 2))
        values = samples(first, last)
        return np.array([[np.fmin.reduce(values), np.fmax.reduce(values)]])


def _extremes(pairs: Floats, begins: NDArray[Any]) -> Floats:
    """Fold rows of minima and maxima from each of `begins` to the next."""
    return np.column_stack(
        [np.fmin.reduceat(pairs[:, 0], begins), np.fmax.reduceat(pairs[:, 1], begins)]
    )
