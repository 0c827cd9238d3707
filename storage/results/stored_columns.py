"""Columns of a store's tables, read from its files, then from the rows that wait for theirs.

Not through zarr, whose 0.8 ms for each would be most of what an answer with thirty columns takes.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.errors import LostObject
from jointplay.storage.packed import Files
from jointplay.storage.results import shards
from jointplay.storage.results.metadata import Document, shape_of
from jointplay.storage.results.waiting import Tail

Index = list[tuple[int, int]]
"""Offset and length of each chunk of a file."""


class StoredColumns:
    """An array of (rows,), one column, or of (rows, columns), whose files have all of some rows.

    Parameters
    ----------
    files
        Of the store.
    path
        Of the array.
    document
        That describes it.
    """

    def __init__(self, files: Files, path: str, document: Document) -> None:
        self._files, self._path = files, path
        self._dtype = np.dtype(document["data_type"])
        self._file_rows, self.chunk_rows = shape_of(document)
        _, *columns = document["shape"]
        self._columns = columns[0] if columns else 1
        self._behind = "/0" if columns else ""
        self._indices: dict[str, Index] = {}

    def read(
        self, first: int, last: int, column: int = 0, tail: Tail | None = None
    ) -> NDArray[Any]:
        """Read rows `first` to `last` - 1 of a column.

        Parameters
        ----------
        first, last
            Rows that are in files, or wait for theirs.
        column
            Of those in a file.
        tail
            Rows of the column that wait; none by default.

        Raises
        ------
        LostObject
            A file of them is gone.
        CorruptStore
            A file has other bytes than were stored.
        """
        durable, waiting = (last, None) if tail is None else tail
        target = np.empty(last - first, self._dtype)
        in_files = min(last, durable)
        files = range(first // self._file_rows, -(-in_files // self._file_rows))
        for file in files if in_files > first else ():
            begin = file * self._file_rows
            low, high = max(first, begin), min(in_files, begin + self._file_rows)
            key = f"{self._path}/c/{file}{self._behind}"
            try:
                found = self._in_file(key, low - begin, high - begin, column)
            except FileNotFoundError as error:
                raise LostObject(str(error)) from error
            target[low - first : high - first] = found
        if waiting is not None and last > durable:
            low = max(first, durable)
            target[low - first :] = waiting[low - durable : last - durable]
        return target

    def _in_file(self, key: str, first: int, last: int, column: int) -> NDArray[Any]:
        rows = self.chunk_rows
        if self._file_rows == rows and not self._behind:  # the file is a chunk
            return shards.decompress(self._files.read(key), self._dtype, rows)[first:last]
        begin, end = first // rows, -(-last // rows)
        index = self._index(key)[begin * self._columns + column : end * self._columns :]
        chunks = [self._chunk(key, *entry) for entry in index[:: self._columns]]
        return np.concatenate(chunks)[first - begin * rows : last - begin * rows]

    def _index(self, key: str) -> Index:
        found = self._indices.get(key)
        if found is None:
            size = self._files.entry(key).size
            length = shards.index_bytes(self._file_rows // self.chunk_rows * self._columns)
            packed = self._files.read(key, size - length, size)
            found = self._indices[key] = shards.unpack_index(packed)
        return found

    def _chunk(self, key: str, offset: int, length: int) -> NDArray[Any]:
        content = self._files.read(key, offset, offset + length)
        return shards.decompress(content, self._dtype, self.chunk_rows)
