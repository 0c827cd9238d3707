"""A growing store as stock Zarr clients may see it: every committed row and no other.

The documents on the disk announce all rows to come; here their shapes end where the run is
committed. The last shard, which is not full yet, is made of the rows that wait for it.
"""

import json
from typing import Any

import numpy as np

from jointplay.records.impact import IMPACT
from jointplay.records.names import TIME
from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.packed import Files, Running
from jointplay.storage.packed.running import PARTS
from jointplay.storage.results import intervals, shards, steps
from jointplay.storage.results.layout import SCHEMA_VERSION
from jointplay.storage.results.metadata import (
    DOUBLE,
    FILE,
    Document,
    documents,
    serialise,
    shape_of,
)
from jointplay.storage.results.waiting import Waiting, waiting_rows
from jointplay.storage.results.wide_table import ARRAY, rows_in_files

_WIDE = {steps.GROUP: steps.ROWS, intervals.GROUP: intervals.ROWS}
"""Tables that clients are not shown, in the order of the journal, and rows of a file."""


class LiveStore:
    """The committed rows of one attempt's store.

    Parameters
    ----------
    files
        Of the store.
    samples
        That are committed: those of its last recorded checkpoint.

    Raises
    ------
    NotAStore
        There is none.
    """

    def __init__(self, files: Running, samples: int) -> None:
        self.files = files
        root = root_of(files)
        self._members: dict[str, Document] = root["consolidated_metadata"]["metadata"]
        self.attributes: dict[str, Any] = root["attributes"]
        self._columns = columns_of(self.attributes)
        self._waiting = committed(files, samples, root)
        shown = {path: self._shown(path) for path in self._members}
        self._documents = documents(root["attributes"], shown)

    def document(self, key: str) -> bytes | None:
        """Give a zarr.json, or None where there is no group or array."""
        found = self._documents.get(key)
        return None if found is None else serialise(found)

    def in_file(self, key: str) -> bool:
        """Whether a chunk is of rows that are in shards, so that its file must be there."""
        path, _, index = key.rpartition("/c/")
        table, _, name = path.rpartition("/")
        if name not in self._columns.get(table, ()) or not index.isdecimal():
            return False
        shard_rows, _ = shape_of(self._members[path])
        return int(index) < self._waiting[table].durable // shard_rows

    def chunk(self, key: str) -> bytes | None:
        """Make the file of a chunk that is not on the disk yet, or None if it has no row.

        Its chunks are where `shards.loose` says, in every version of it, so that a client that
        has read the index of an earlier one reads right.
        """
        path, _, index = key.rpartition("/c/")
        table, _, name = path.rpartition("/")
        names = self._columns.get(table, ())
        if path not in self._members or name not in names or not index.isdecimal():
            return None
        waiting = self._waiting[table]
        array = self._members[path]
        shard_rows, chunk_rows = shape_of(array)
        if int(index) != waiting.durable // shard_rows or waiting.rows == waiting.durable:
            return None
        rows = waiting.columns[names.index(name)]
        if shard_rows == chunk_rows:
            return shards.encode(rows, chunk_rows, shard_rows)
        chunks = [rows[i : i + chunk_rows] for i in range(0, shard_rows, chunk_rows)]
        return shards.loose(chunks, chunk_rows)

    def _shown(self, name: str) -> Document:
        document = self._members[name]
        path, _, column = name.rpartition("/")
        if document["node_type"] == "array" and column in self._columns.get(path, ()):
            return document | {"shape": [self._waiting[path].rows]}
        return document


def loosened(array: Document | None, content: bytes) -> bytes | None:
    """Give a shard of an array in the form of `shards.loose`; None if it is no such shard."""
    if array is None or array["node_type"] != "array" or len(array["shape"]) != 1:
        return None
    shard_rows, chunk_rows = shape_of(array)
    if shard_rows == chunk_rows:
        return None
    dtype = np.dtype(array["data_type"])
    chunks = shards.chunks_of(content, shard_rows // chunk_rows, dtype, chunk_rows)
    return shards.loose(chunks, chunk_rows)


def columns_of(attributes: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Name the columns of each table that grows, by group, in the order of the journal."""
    sampled = (*attributes["channels"], TIME)
    found = {"": sampled, "poincare": sampled, "impacts": IMPACT.names or ()}
    if kept := tuple(attributes.get("steps", ())):
        found[steps.GROUP] = kept
    if attributes.get("intervals"):
        found[intervals.GROUP] = intervals.columns(attributes["channels"])
    return found


def root_of(files: Files) -> Document:
    """Read the root's document, with those of everything below it.

    Raises
    ------
    NotAStore
        There is none of a results store.
    """
    try:
        root: Document = json.loads(files.read(FILE))
        schema = root["attributes"].get("result_schema")
        _ = root["consolidated_metadata"]["metadata"]
    except (FileNotFoundError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise NotAStore("there are no results of a run") from error
    if schema != SCHEMA_VERSION:
        raise NotAStore(f"these have result schema {schema}; this version reads {SCHEMA_VERSION}")
    return root


def rows_in_shards(files: Running, root: Document, table: str) -> int:
    """Count the rows of a growing table whose shards are on the disk."""
    if table in _WIDE:
        return rows_in_files(files, table, _WIDE[table])
    key = _any_key(root, table)
    array = root["consolidated_metadata"]["metadata"][key]
    shards_there = files.shards(f"{key}/c/{{}}")
    return min(shards_there * shape_of(array)[0], int(array["shape"][0]))


def _any_key(root: Document, table: str) -> str:
    """Return the path of one column of a growing table; all are cut alike."""
    if table in _WIDE:
        return f"{table}/{ARRAY}"
    return f"{table}/{columns_of(root['attributes'])[table][-1]}".lstrip("/")


def committed(files: Running, samples: int, root: Document) -> dict[str, Waiting]:
    """Find how far each table was when that many samples were committed, by group.

    Once the journal of that moment was replaced by a later one, all whole shards count.

    Raises
    ------
    CorruptStore
        Rows that are committed are not there, or the journal has other bytes than were written.
    """
    columns = columns_of(root["attributes"])
    sampled = [DOUBLE] * len(columns[""])
    dtypes = [sampled, sampled, [IMPACT[name] for name in columns["impacts"]]]
    dtypes += [[DOUBLE] * len(columns[table]) for table in _WIDE if table in columns]
    waiting = waiting_rows(files, samples, dtypes)
    in_shards = {table: rows_in_shards(files, root, table) for table in columns}
    if waiting is None:
        found = {
            table: Waiting(rows if table else min(rows, samples), ())
            for table, rows in in_shards.items()
        }
        needed = {"": samples + 1 if samples else 0}  # a later journal begins behind these
    else:
        found = dict(zip(columns, waiting, strict=True))
        needed = {table: one.durable for table, one in found.items()}
    for table, rows in needed.items():
        if in_shards[table] < rows and files.sealed() is None:
            raise CorruptStore(_lost(files, root, table, in_shards[table], samples))
    return found


def _lost(files: Running, root: Document, table: str, rows: int, samples: int) -> str:
    key = _any_key(root, table)
    if table in _WIDE:
        following = files.file_of(f"{key}/c/{rows // _WIDE[table]}/0")
    else:
        shard_rows, _ = shape_of(root["consolidated_metadata"]["metadata"][key])
        following = files.file_of(f"{key}/c/{rows // shard_rows}")
    return (
        f"of {samples} samples that are committed, {rows} rows of {table or 'the history'} are in"
        f" the shards of {files.name}: {following} is gone, or the journal in {PARTS} has"
        " other bytes than were written"
    )
