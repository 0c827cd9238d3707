"""Open one file of a store: below its folder, and through no symbolic link."""

import os
import stat
from pathlib import Path


def open_below(folder: Path, key: str) -> int | None:
    """Return a descriptor of the file of a key, or None if there is no such plain file.

    Every component is opened from the one before and must not be a symbolic link, so that what
    is opened lies in the folder even if somebody could plant links there.
    """
    *parents, name = key.split("/")
    try:
        at = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    try:
        for parent in parents:
            below = os.open(parent, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=at)
            os.close(at)
            at = below
        file = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=at)
    except OSError:
        return None
    finally:
        os.close(at)
    if stat.S_ISREG(os.fstat(file).st_mode):
        return file
    os.close(file)
    return None


def read(descriptor: int, start: int, stop: int) -> bytes:
    """Read bytes [start, stop) of a file."""
    pieces = []
    while start < stop:
        piece = os.pread(descriptor, stop - start, start)
        if not piece:
            break
        pieces.append(piece)
        start += len(piece)
    return b"".join(pieces)
