"""Rows of a growing store that are on the disk but wait for their shard to fill.

They are in the journal, whose last checkpoint says how far the run is committed.
"""

import hashlib
import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from jointplay.records.checkpoint import ForeignCheckpoint, UnusableCheckpoint, decode
from jointplay.storage.errors import CheckpointMismatch, CorruptStore
from jointplay.storage.packed.running import PARTS, Running
from jointplay.storage.results.growing_table import GrowingTable
from jointplay.storage.results.journal import CHECKSUM, KIND, ROWS


class Checkpoint:
    """A checkpoint read back.

    Raises
    ------
    CheckpointMismatch
        The bytes are no checkpoint of a store with this layout.
    """

    def __init__(self, content: bytes, layout_digest: str) -> None:
        try:
            token, _ = decode(content, KIND, layout_digest)
        except ForeignCheckpoint as error:
            raise CheckpointMismatch(
                "the checkpoint belongs to a store with other channels, counts or joints"
            ) from error
        except UnusableCheckpoint as error:
            raise CheckpointMismatch("these bytes are no checkpoint of a results store") from error
        self.durable: list[int] = token["durable"]
        self._token = token

    def replay(self, lost: Running, tables: Sequence[GrowingTable]) -> None:
        """Append the rows that waited at the checkpoint, from the journal of a lost attempt.

        Raises
        ------
        CheckpointMismatch
            The journal is not there.
        CorruptStore
            It is not the one that the checkpoint describes.
        """
        name = f"{self._token['generation']:08d}"
        try:
            content = lost.part(name)[: self._token["size"]]
        except FileNotFoundError as error:
            sentence = f"{PARTS}/{name} of {lost} is gone: resume where it was written"
            raise CheckpointMismatch(sentence) from error
        if hashlib.sha256(content).hexdigest() != self._token["sha256"]:
            raise CorruptStore(
                f"{PARTS}/{name} of {lost} has not the bytes that the checkpoint describes"
            )
        _, frames = _read(content, lost.digest)
        for position, table in enumerate(tables):
            dtypes = [column.dtype for column in table.table.columns]
            table.append(_columns(content, [one[position] for one in frames], dtypes))


Tail = tuple[int, NDArray[Any]]
"""Rows of a column that are in shards: how many, and those that follow."""


@dataclass(frozen=True)
class Waiting:
    """Rows of one table: `durable` are in shards, the columns hold those that follow."""

    durable: int
    columns: tuple[NDArray[Any], ...]

    @property
    def rows(self) -> int:
        """Rows in shards and after them."""
        return self.durable + (len(self.columns[0]) if self.columns else 0)

    def column(self, position: int) -> Tail | None:
        """Return the rows of one column that wait; None where no row does."""
        return (self.durable, self.columns[position]) if self.columns else None


def waiting_rows(
    files: Running, samples: int, dtypes: Sequence[Sequence[np.dtype[Any]]]
) -> list[Waiting] | None:
    """Read what waited at the checkpoint with that many samples.

    Parameters
    ----------
    files
        Of the store.
    samples
        Rows of the first table at the checkpoint.
    dtypes
        Of the columns of the first tables; later ones are skipped.

    Returns
    -------
    list
        One for each table of `dtypes`, or None if no journal has this checkpoint: it was
        removed, replaced by a later one, or has other bytes than were written.
    """
    for name in reversed(files.parts()):
        with suppress(FileNotFoundError):
            found = _at(files.part(name), files.digest, samples, dtypes)
            if found is not None:
                return found
    return None


def _at(
    content: bytes, digest: bytes, samples: int, dtypes: Sequence[Sequence[np.dtype[Any]]]
) -> list[Waiting] | None:
    """Find the last checkpoint of a generation that has this many samples."""
    durable, frames = _read(content, digest)
    if not frames:
        return None
    rows = durable[0] + np.cumsum([frame[0].rows for frame in frames])
    reached = int(np.searchsorted(rows, samples, side="right"))
    if not reached or rows[reached - 1] != samples:
        return None
    return [
        Waiting(durable[table], _columns(content, [one[table] for one in frames[:reached]], wanted))
        for table, wanted in enumerate(dtypes)
    ]


class _Frame(NamedTuple):
    """Rows of one table at one checkpoint: where in the file their columns begin."""

    offset: int
    rows: int


def _read(content: bytes, digest: bytes) -> tuple[list[int], list[list[_Frame]]]:
    """Find rows in shards by table, and the frames, one a table, of every whole checkpoint.

    What follows a checkpoint that is being written, or has other bytes than were written, is none.
    """
    checksum = crc32(digest)
    begin = content.find(b"\n") + 1
    line = content[9 : begin - 1]
    if not begin or content[:9] != b"%08x " % crc32(line, checksum):
        return [], []
    known = json.loads(line)
    checked = 0
    found: list[list[_Frame]] = []
    while True:
        frames: list[_Frame] = []
        offset = begin
        for size in known["row_bytes"]:
            if offset + ROWS.size > len(content):
                return known["durable"], found
            (rows,) = ROWS.unpack_from(content, offset)
            offset += ROWS.size
            frames.append(_Frame(offset, rows))
            offset += rows * size
        begin = offset + CHECKSUM.size
        if begin > len(content):
            return known["durable"], found
        checksum = crc32(memoryview(content)[checked:offset], checksum)
        if content[offset:begin] != CHECKSUM.pack(checksum):
            return known["durable"], found
        checked = begin
        found.append(frames)


def _columns(
    content: bytes, frames: Sequence[_Frame], dtypes: Sequence[np.dtype[Any]]
) -> tuple[NDArray[Any], ...]:
    found: list[list[NDArray[Any]]] = [[] for _ in dtypes]
    for offset, rows in frames:
        for column, dtype in zip(found, dtypes, strict=True):
            column.append(np.frombuffer(content, dtype, rows, offset))
            offset += rows * dtype.itemsize
    return tuple(np.concatenate(column) for column in found)
