"""Files of a store by key; those of a packed one are found by its central directory."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from jointplay.storage.errors import NotAStore
from jointplay.storage.packed.writing import CENTRAL, COMMENT, END, END_64, LOCAL, LOCATOR, LONG

_TAIL = 2**16
"""Bytes read first: the whole directory of a store of some hundred arrays."""


class Entry(NamedTuple):
    """Where a file's bytes begin in a packed one, how many there are, and their CRC-32."""

    offset: int
    size: int
    crc: int


class Files(Protocol):
    """Readable files of a store: sealed and packed, or being filled."""

    def __iter__(self) -> Iterator[str]:
        """Yield the keys that can be listed: all once sealed, else those of the documents."""
        ...

    def entry(self, key: str) -> Entry:
        """Return size and CRC-32 of a file; FileNotFoundError if there is none."""
        ...

    def read(self, key: str, start: int = 0, stop: int | None = None) -> bytes:
        """Return bytes [start, stop) of a file, to its end by default.

        Raises
        ------
        FileNotFoundError
            There is none of this key.
        """
        ...


class Ranges(Protocol):
    """Bytes that are read by ranges, such as an object of a place."""

    def size(self) -> int:
        """Return how many there are; FileNotFoundError if there is nothing."""
        ...

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        ...


@dataclass
class Packed:
    """The files of one packed store, read by ranges.

    Raises
    ------
    NotAStore
        There is no such object, or another program packed it.
    """

    source: Ranges
    entries: dict[str, Entry] = field(init=False)

    def __post_init__(self) -> None:
        try:
            size = self.source.size()
            tail = self.source.read(max(size - _TAIL, 0), size)
        except FileNotFoundError as error:
            raise NotAStore(f"{self.source} holds no results") from error
        begin = len(tail) - END.size - len(COMMENT)
        if not tail.endswith(COMMENT) or tail[begin : begin + 4] != b"PK\5\6":
            raise NotAStore(f"{self.source} is not a file of results: it was cut off, or repacked")
        *_, count, length, first, _ = END.unpack_from(tail, begin)
        locator = begin - LOCATOR.size
        if locator >= 0 and tail[locator : locator + 4] == b"PK\6\7":
            *_, count, length, first = END_64.unpack_from(tail, locator - END_64.size)
        behind = size - first
        directory = (
            tail[len(tail) - behind :][:length]
            if behind <= len(tail)
            else self.source.read(first, first + length)
        )
        self.entries = dict(_entries(directory, count))

    def __iter__(self) -> Iterator[str]:
        """Yield all keys, in the order in which they were packed."""
        return iter(self.entries)

    def read(self, key: str, start: int = 0, stop: int | None = None) -> bytes:
        """Return bytes [start, stop) of a file, to its end by default."""
        entry = self.entry(key)
        stop = entry.size if stop is None else min(stop, entry.size)
        return self.source.read(entry.offset + start, entry.offset + stop)

    def entry(self, key: str) -> Entry:
        """Return where a file is; FileNotFoundError if there is none."""
        try:
            return self.entries[key]
        except KeyError:
            raise FileNotFoundError(f"{self.source} has no {key!r}") from None


def _entries(directory: bytes, count: int) -> Iterator[tuple[str, Entry]]:
    at = 0
    for _ in range(count):
        about = CENTRAL.unpack_from(directory, at)
        crc, _, size, name_length, extra = about[7:12]
        offset = about[-1]
        at += CENTRAL.size
        name = directory[at : at + name_length]
        at += name_length
        if offset == LONG and extra:
            offset = int.from_bytes(directory[at + 4 : at + 12], "little")
        at += extra
        yield name.decode(), Entry(offset + LOCAL.size + name_length, size, crc)
