"""Text of a file that was named on the command line, or came through a pipe."""

from functools import cache
from pathlib import Path


def is_read(source: str) -> bool:
    """Tell whether a name is that of a file, a pipe or a device to read from."""
    path = Path(source)
    return path.exists() and not path.is_dir()


def text_of(source: str) -> bytes:
    """Return what a file holds; of a pipe, which can be read once, what it held the first time."""
    path = Path(source)
    if path.is_file():
        return path.read_bytes()
    found = path.stat()
    return _drained(path, found.st_dev, found.st_ino)


@cache
def _drained(path: Path, device: int, number: int) -> bytes:
    """Read a pipe; device and number tell it from others that had its path before."""
    return path.read_bytes()
