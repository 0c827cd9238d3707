"""Content that is read from its beginning to its end, of which each reading is a request."""

from typing import Final, Protocol

_PART: Final = 2**23  # bytes


class _Ranges(Protocol):
    def size(self) -> int: ...

    def read(self, start: int, stop: int) -> bytes: ...


class InParts:
    """Bytes that are read in large parts, of which the last one is kept.

    Parameters
    ----------
    name
        For sentences.
    source
        Of the bytes.
    """

    def __init__(self, name: str, source: _Ranges) -> None:
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
