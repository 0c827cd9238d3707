"""Files of an array's chunks: which there can be, and whether one holds what its document says."""

from collections.abc import Iterator
from itertools import product
from math import ceil, prod
from typing import Any, Final

import numpy as np

from jointplay.storage.errors import CorruptStore
from jointplay.storage.results import shards
from jointplay.storage.results.metadata import Document

_OVERHEAD: Final = 64
"""Bytes of a chunk at most beside its values: header, and offset and length in an index."""


class ChunkFiles:
    """Those of one array.

    Parameters
    ----------
    path
        Of the array.
    document
        That describes it.
    """

    def __init__(self, path: str, document: Document) -> None:
        self._path = path
        self._shape: list[int] = document["shape"]
        self._in_file: list[int] = document["chunk_grid"]["configuration"]["chunk_shape"]
        codec = document["codecs"][0]
        self._is_shard = codec["name"] == "sharding_indexed"
        self._chunk: list[int] = (
            codec["configuration"]["chunk_shape"] if self._is_shard else self._in_file
        )
        self._dtype: np.dtype[Any] = np.dtype(document["data_type"])
        self._grid = [
            ceil(length / size) for length, size in zip(self._shape, self._in_file, strict=True)
        ]

    @property
    def count(self) -> int:
        """Number of files that there can be."""
        return prod(self._grid)

    def keys(self) -> Iterator[str]:
        """Name them all."""
        for index in product(*map(range, self._grid)):
            yield f"{self._path}/c/{'/'.join(map(str, index))}"

    def has(self, index: str) -> bool:
        """Whether an index such as ``3/0`` is in the grid."""
        numbers = index.split("/")
        return len(numbers) == len(self._grid) and all(
            one.isdecimal() and one == str(int(one)) and int(one) < length
            for one, length in zip(numbers, self._grid, strict=True)
        )

    @property
    def largest(self) -> int:
        """Bytes of one file at most."""
        chunks = prod(self._in_file) // max(prod(self._chunk), 1)
        return prod(self._in_file) * self._dtype.itemsize + _OVERHEAD * (chunks + 1)

    def check(self, index: str, content: bytes) -> None:
        """Raise `CorruptStore` if a file cannot be read as the chunks at an index of the grid."""
        if not self._is_shard:
            self._decode(content)
            return
        chunks = prod(self._in_file) // prod(self._chunk)
        entries = shards.unpack_index(content[-shards.index_bytes(chunks) :])
        rows = self._shape[0] - int(index.partition("/")[0]) * self._in_file[0]
        needed = chunks if len(self._shape) > 1 else min(chunks, ceil(rows / self._chunk[0]))
        for number, (offset, length) in enumerate(entries):
            if length:
                self._decode(content[offset : offset + length])
            elif number < needed:
                raise CorruptStore("a chunk is missing")

    def _decode(self, chunk: bytes) -> None:
        """Decode one chunk, whose header says how much memory that takes."""
        if not chunk:
            raise CorruptStore("a chunk is cut off")
        shards.decompress(chunk, self._dtype, prod(self._chunk))
