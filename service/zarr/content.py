"""Content served of a store: bytes of a file, or bytes that were made of a growing store."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from typing import Self

from jointplay.storage.packed import Files


@dataclass
class Content:
    """One representation of a key."""

    size: int
    tag: str
    """Strong entity tag, in its quotes."""
    read: Callable[[int, int], bytes]
    """Gives bytes [start, stop)."""
    final: bool = False
    """The key will never hold anything else."""

    @classmethod
    def of_file(cls, files: Files, key: str) -> Self | None:
        """Take a file of a store; None if it is not there.

        A chunk is stored once, so that its checksum tells it from what was made before.
        """
        try:
            entry = files.entry(key)
        except FileNotFoundError:
            return None
        return cls(entry.size, f'"{entry.crc:08x}-{entry.size:x}"', partial(files.read, key))

    @classmethod
    def of_bytes(cls, content: bytes) -> Self:
        """Take bytes that were made."""
        tag = f'"{sha256(content).hexdigest()[:32]}"'
        return cls(len(content), tag, lambda start, stop: content[start:stop])
