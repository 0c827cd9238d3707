"""Files of one store by key, wherever they are."""

from collections.abc import Iterator
from typing import NamedTuple, Protocol


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
