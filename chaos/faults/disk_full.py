"""A disk on which nothing more can be stored, until somebody makes room."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_PIECES = (2**20, 2**12)  # bytes


class DiskFull(Fault):
    """A file that takes all that is left of a disk, which must be the service's own."""

    lasts = (10.0, 600.0)

    def hindrance(self, installation: Installation) -> str | None:
        """Return why, unless the data folder is a file system of its own."""
        if os.path.ismount(installation.data):
            return None
        return "unshare and mount cannot make a small disk here, and others' is never filled"

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Fill the disk, and remove the file."""
        ballast = installation.data / "ballast"
        try:
            with ballast.open("wb", buffering=0) as file:
                for size in _PIECES:
                    _fill(file.fileno(), bytes(size))
            yield
        finally:
            ballast.unlink(missing_ok=True)


def _fill(descriptor: int, piece: bytes) -> None:
    try:
        while True:
            os.write(descriptor, piece)
    except OSError:  # it is full
        return
