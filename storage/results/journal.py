"""Rows that wait for their shard, kept on the disk so that a checkpoint stays small.

One file per generation below `parts`; a generation begins with all rows that wait at its
first checkpoint and grows by what is appended between checkpoints; a written shard starts the
next one. So no generation holds more than the buffers of the tables.

A generation begins with a line: its CRC-32, then JSON with how many rows of each table are in
shards, and how many bytes a row takes. Then follows, for each checkpoint and table, a frame: the
number of new rows and their columns; behind the frames of a checkpoint stands the CRC-32 of all
before. Checksums begin with the digest of what is computed. `storage.results.waiting` reads it.
"""

import hashlib
import json
import os
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final
from zlib import crc32

import numpy as np

from jointplay.records.checkpoint import encode
from jointplay.storage.durable import sync
from jointplay.storage.packed.running import PARTS, Running
from jointplay.storage.results.growing_table import GrowingTable

_KEPT_GENERATIONS: Final = 3
ROWS: Final = struct.Struct("<Q")
CHECKSUM: Final = struct.Struct("<I")
KIND: Final = "growing results"


class Journal:
    """Makes checkpoints of growing tables.

    Parameters
    ----------
    files
        Of the store.
    layout_digest
        Goes into every checkpoint, to be compared when one is resumed.
    """

    def __init__(self, files: Running, layout_digest: str) -> None:
        self._folder = files.folder / PARTS
        self._files = files
        self._layout_digest = layout_digest
        self._generation = 0
        self._size = 0
        self._checksum = 0
        self._hash = hashlib.sha256()
        self._durable: list[int] | None = None
        self._journalled: list[int] = []

    def checkpoint(self, tables: Sequence[GrowingTable]) -> bytes:
        """Bring the waiting rows to the disk and return what finds them again."""
        durable = [table.durable for table in tables]
        if durable != self._durable:
            self._begin(durable)
        checksum = self._checksum if self._size else crc32(self._files.digest)
        digest, size = self._hash.copy(), self._size
        descriptor = os.open(self._path(self._generation), os.O_WRONLY | os.O_CREAT, 0o666)
        with open(descriptor, "wb") as file:
            file.seek(size)
            for piece in self._pieces(tables):
                checksum = crc32(piece, checksum)
                digest.update(piece)
                size += file.write(piece)
            end = CHECKSUM.pack(checksum)
            digest.update(end)
            size += file.write(end)
            file.truncate()  # of a checkpoint that could not be written there may be more
            file.flush()
            os.fsync(descriptor)
        if self._size == 0:
            sync(self._folder)
            sync(self._folder.parent)
        self._size, self._checksum, self._hash = size, checksum, digest
        self._journalled = [table.rows for table in tables]
        token = {
            "generation": self._generation,
            "size": self._size,
            "sha256": self._hash.hexdigest(),
            "durable": durable,
        }
        return encode(KIND, self._layout_digest, token, {})

    def _begin(self, durable: list[int]) -> None:
        self._generation += 1
        self._size = 0
        self._checksum = 0
        self._hash = hashlib.sha256()
        self._durable = durable
        self._journalled = list(durable)
        self._path(self._generation - _KEPT_GENERATIONS).unlink(missing_ok=True)

    def _pieces(self, tables: Sequence[GrowingTable]) -> Iterator[bytes | memoryview]:
        """Give what a checkpoint adds, without copies: what waits is most of a worker's memory."""
        if self._size == 0:
            yield _header(tables, crc32(self._files.digest))
        for table, first in zip(tables, self._journalled, strict=True):
            yield ROWS.pack(table.rows - first)
            for column in table.pending(first):
                yield column.view(np.uint8).data

    def _path(self, generation: int) -> Path:
        return self._folder / f"{generation:08d}"


def _header(tables: Sequence[GrowingTable], checksum: int) -> bytes:
    row_bytes = [sum(c.dtype.itemsize for c in table.table.columns) for table in tables]
    known = {"durable": [table.durable for table in tables], "row_bytes": row_bytes}
    line = json.dumps(known).encode()
    return b"%08x %s\n" % (crc32(line, checksum), line)
