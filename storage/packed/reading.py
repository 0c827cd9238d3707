"""Files of a store by key; those of a packed one are found by its central directory."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf
from typing import NamedTuple, Protocol
from zlib import crc32

from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.packed.ranges import Ranges
from jointplay.storage.packed.writing import (
    CENTRAL,
    COMMENT,
    END,
    END_64,
    LOCAL,
    LOCATOR,
    LONG,
    comment,
    local_header,
)

_TAIL = 2**16
"""Bytes read first: the whole directory of a store of some hundred arrays."""

_TOGETHER = 2**20
"""Bytes that are checked in one read, if no file has more."""


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


@dataclass
class Packed:
    """The files of one packed store, read by ranges.

    Nothing is given out that is not what was packed: a checksum covers the directory, and every
    file is compared with its own, whole, when it is first read.

    Raises
    ------
    NotAStore
        There is no such object, or another program packed it.
    CorruptStore
        It was cut off, its directory has other bytes than it had, or it is of something else.
    """

    source: Ranges
    digest: bytes = b""
    """Digest of what is stored, for files that do not hold it; see `pack`."""
    most: float = inf
    """Bytes of a directory that is read."""
    entries: dict[str, Entry] = field(init=False)
    _checked: set[str] = field(init=False, default_factory=set)

    def __post_init__(self) -> None:
        try:
            size = self.source.size()
            tail = self.source.read(max(size - _TAIL, 0), size)
        except FileNotFoundError as error:
            raise NotAStore(f"{self.source} is not there") from error
        begin = len(tail) - COMMENT.size - END.size
        if begin < 0 or tail[begin : begin + 4] != b"PK\5\6":
            raise CorruptStore(f"{self.source} is cut off: it has no directory at its end")
        records = END.size + COMMENT.size
        *_, count, length, first, _ = END.unpack_from(tail, begin)
        locator = begin - LOCATOR.size
        if locator >= END_64.size and tail[locator : locator + 4] == b"PK\6\7":
            *_, count, length, first = END_64.unpack_from(tail, locator - END_64.size)
            records += END_64.size + LOCATOR.size
        if first + length + records != size:  # before so many bytes are asked for
            raise CorruptStore(f"the directory of {self.source} is not where it was")
        if length > self.most:
            raise CorruptStore(f"the directory of {self.source} has more than {self.most:g} bytes")
        behind = size - first
        end = tail[-behind:] if behind <= len(tail) else self.source.read(first, size)
        if comment(end[: -COMMENT.size], self.digest) != end[-COMMENT.size :]:
            raise CorruptStore(f"the directory of {self.source} has other bytes than it had")
        self.entries = dict(_entries(end[:length], count))

    def __iter__(self) -> Iterator[str]:
        """Yield all keys, in the order in which they were packed."""
        return iter(self.entries)

    def read(self, key: str, start: int = 0, stop: int | None = None) -> bytes:
        """Return bytes [start, stop) of a file, to its end by default.

        Raises
        ------
        FileNotFoundError
            There is none of this key.
        CorruptStore
            It has other bytes than were packed.
        """
        entry = self.entry(key)
        stop = entry.size if stop is None else min(stop, entry.size)
        if key not in self._checked:
            return self._first(key, entry)[start:stop]
        return self._bytes(entry.offset + start, entry.offset + stop)

    def entry(self, key: str) -> Entry:
        """Return where a file is; FileNotFoundError if there is none."""
        try:
            return self.entries[key]
        except KeyError:
            raise FileNotFoundError(f"{self.source} has no {key!r}") from None

    def _first(self, key: str, entry: Entry) -> bytes:
        """Read a file whole, with the header before it, and compare it with its checksum."""
        found = self._bytes(_begin(key, entry), entry.offset + entry.size)
        content = self._compared(key, entry, found)
        self._checked.add(key)
        return content

    def check(self, start: int, stop: int) -> None:
        """Compare all files with bytes in [start, stop) with their checksums, as they are now.

        Raises
        ------
        CorruptStore
            One has other bytes than were packed, or all are gone.
        """
        asked = [
            (key, entry)
            for key, entry in self.entries.items()
            if _begin(key, entry) < stop and entry.offset + entry.size > start
        ]
        while asked:  # some in one read
            begin = _begin(*asked[0])
            near = [one for one in asked if one[1].offset + one[1].size <= begin + _TOGETHER]
            near = near or asked[:1]
            end = near[-1][1].offset + near[-1][1].size
            found = memoryview(self._bytes(begin, end))
            for key, entry in near:
                within = slice(_begin(key, entry) - begin, entry.offset + entry.size - begin)
                self._compared(key, entry, bytes(found[within]))
            asked = asked[len(near) :]

    def require_in_order(self) -> None:
        """Raise `CorruptStore` if files do not lie one behind the other, as they are packed."""
        end = 0
        for key, entry in self.entries.items():
            if _begin(key, entry) != end:
                raise CorruptStore(f"{key} of {self.source} is not behind the file before it")
            end = entry.offset + entry.size

    def _compared(self, key: str, entry: Entry, found: bytes) -> bytes:
        """Return the content of a file that was read with the header before it."""
        header = local_header(key.encode(), entry.crc, entry.size)
        content = found[len(header) :]
        expected = entry.size, entry.crc
        if not found.startswith(header) or (len(content), crc32(content)) != expected:
            raise CorruptStore(f"{key} of {self.source} has other bytes than were stored")
        return content

    def _bytes(self, start: int, stop: int) -> bytes:
        try:
            return self.source.read(start, stop)
        except FileNotFoundError as error:
            raise LostObject(f"{self.source} was removed") from error


def _begin(key: str, entry: Entry) -> int:
    """Return where the header before a file begins."""
    return entry.offset - LOCAL.size - len(key.encode())


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
