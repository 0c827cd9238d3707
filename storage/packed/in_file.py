"""Content of a packed file that is open and has no name."""

import os
from typing import IO


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
