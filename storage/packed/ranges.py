"""Bytes that are read by ranges: an object of a store, a file without a name, or in memory."""

import os
from pathlib import Path
from typing import IO, Final, Protocol
from weakref import finalize

_PART: Final = 2**23  # bytes


class Ranges(Protocol):
    """Bytes that are read by ranges; its string is their name, for sentences."""

    def size(self) -> int:
        """Return how many bytes there are; FileNotFoundError if there is nothing."""
        ...

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        ...


class InMemory:
    """Bytes of a name to be read by ranges."""

    def __init__(self, name: str, content: bytes) -> None:
        self._name = name
        self._content = content

    def __str__(self) -> str:
        return self._name

    def size(self) -> int:
        """Return how many there are."""
        return len(self._content)

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        return self._content[start:stop]


class InFile:
    """Bytes of a file to be read by ranges.

    Parameters
    ----------
    name
        For sentences.
    file
        Whose bytes have all left its buffer.
    """

    def __init__(self, name: str, file: IO[bytes]) -> None:
        self._name = name
        self._descriptor = file.fileno()

    def __str__(self) -> str:
        return self._name

    def size(self) -> int:
        """Return how many there are."""
        return os.fstat(self._descriptor).st_size

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        return os.pread(self._descriptor, stop - start, start)


class OpenFile(InFile):
    """Bytes of the file of a path, which is open until nobody uses this any more.

    Whoever removes it meanwhile removes its name.

    Parameters
    ----------
    name
        For sentences.
    path
        Of the file; FileNotFoundError if there is none.
    """

    def __init__(self, name: str, path: Path) -> None:
        self._name = name
        self._descriptor = os.open(path, os.O_RDONLY)
        finalize(self, os.close, self._descriptor)


class InParts:
    """Bytes whose every reading is a request: read in large parts, of which the last one is kept.

    Parameters
    ----------
    name
        For sentences.
    source
        Of the bytes.
    """

    def __init__(self, name: str, source: Ranges) -> None:
        self._name = name
        self._source = source
        self._size = source.size()
        self._start = 0
        self._part = b""

    def __str__(self) -> str:
        return self._name

    def size(self) -> int:
        """Return how many there are."""
        return self._size

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        end = self._start + len(self._part)
        if not self._start <= start <= stop <= end:
            self._start = start
            self._part = self._source.read(start, min(max(stop, start + _PART), self._size))
        return self._part[start - self._start : stop - self._start]
