"""Rows of a growing store that are on the disk but wait for their shard to fill.

They are in the journal, whose last checkpoint says how far the run is committed.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.results.journal import FOLDER, ROWS


@dataclass(frozen=True)
class Waiting:
    """Rows of one table: `durable` are in shards, the columns hold those that follow."""

    durable: int
    columns: tuple[NDArray[Any], ...]

    @property
    def rows(self) -> int:
        """Rows in shards and after them."""
        return self.durable + (len(self.columns[0]) if self.columns else 0)


def waiting_rows(
    root: Path, samples: int, dtypes: Sequence[Sequence[np.dtype[Any]]]
) -> list[Waiting] | None:
    """Read what waited at the checkpoint with that many samples.

    Parameters
    ----------
    root
        Folder of the store.
    samples
        Rows of the first table at the checkpoint.
    dtypes
        Of the columns of the first tables; later ones are skipped.

    Returns
    -------
    list
        One for each table of `dtypes`, or None if no journal has this checkpoint: it was
        removed, or replaced by a later one.
    """
    try:
        paths = sorted((root / FOLDER).iterdir(), reverse=True)
    except FileNotFoundError:
        return None
    for path in paths:
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            continue
        found = _at(content, samples, dtypes)
        if found is not None:
            return found
    return None


def _at(
    content: bytes, samples: int, dtypes: Sequence[Sequence[np.dtype[Any]]]
) -> list[Waiting] | None:
    """Find the last checkpoint of a generation that has this many samples."""
    begin = content.find(b"\n") + 1
    if not begin:
        return None
    known = json.loads(content[:begin])
    durable: list[int] = known["durable"]
    counts = [0] * len(durable)
    pieces: list[list[tuple[int, int]]] = [[] for _ in durable]  # (offset, rows) of frames
    reached: list[int] | None = None
    offset = begin
    while counts[0] + durable[0] <= samples:
        for table, row_bytes in enumerate(known["row_bytes"]):
            if offset + ROWS.size > len(content):
                break
            (rows,) = ROWS.unpack_from(content, offset)
            offset += ROWS.size
            pieces[table].append((offset, rows))
            counts[table] += rows
            offset += rows * row_bytes
        else:
            if offset <= len(content):
                if counts[0] + durable[0] == samples:
                    reached = [len(one) for one in pieces]
                continue
        break  # the next checkpoint is being written
    if reached is None:
        return None
    return [
        Waiting(durable[table], _columns(content, pieces[table][: reached[table]], wanted))
        for table, wanted in enumerate(dtypes)
    ]


def _columns(
    content: bytes, frames: Sequence[tuple[int, int]], dtypes: Sequence[np.dtype[Any]]
) -> tuple[NDArray[Any], ...]:
    found: list[list[NDArray[Any]]] = [[] for _ in dtypes]
    for begin, rows in frames:
        offset = begin
        for column, dtype in zip(found, dtypes, strict=True):
            column.append(np.frombuffer(content, dtype, rows, offset))
            offset += rows * dtype.itemsize
    return tuple(np.concatenate(column) for column in found)
