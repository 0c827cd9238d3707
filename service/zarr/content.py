"""What is served of a store: bytes of a file, or bytes that were made of a growing store."""

import os
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Self

from jointplay.service.zarr.files import open_below, read


@dataclass
class Content:
    """One representation; `close` it after reading."""

    size: int
    tag: str
    """Strong entity tag, in its quotes."""
    _memory: bytes | None = None
    _descriptor: int | None = None
    final: bool = False
    """The key will never hold anything else."""

    @classmethod
    def of_file(cls, folder: Path, key: str) -> Self | None:
        """Take a file of a store; None if it is not there.

        Files appear whole under their names and are never written to again, so size, time and
        the file's number tell them apart.
        """
        descriptor = open_below(folder, key)
        if descriptor is None:
            return None
        about = os.fstat(descriptor)
        tag = f'"{about.st_size:x}-{about.st_mtime_ns:x}-{about.st_ino:x}"'
        return cls(about.st_size, tag, None, descriptor)

    @classmethod
    def of_bytes(cls, content: bytes) -> Self:
        """Take bytes that were made."""
        return cls(len(content), f'"{sha256(content).hexdigest()[:32]}"', content)

    def read(self, start: int, stop: int) -> bytes:
        """Give bytes [start, stop)."""
        if self._descriptor is None:
            return (self._memory or b"")[start:stop]
        return read(self._descriptor, start, stop)

    def close(self) -> None:
        """Let go of the file."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None
