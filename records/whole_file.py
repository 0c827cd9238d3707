"""A file that is there as a whole or not at all, whatever interrupts its writing."""

import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from errno import ENOENT
from os import strerror
from pathlib import Path


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Give a name beside a file's, of the same form; it is renamed if all goes well, else removed.

    A file that was there before stays until then. Behind a link, that is the file that it leads to.
    What is no file, such as a pipe or a terminal, is given as it is.
    """
    if path.exists() and not path.is_file():
        yield path
        return
    path = path.resolve()
    if not path.parent.is_dir():
        raise FileNotFoundError(ENOENT, strerror(ENOENT), str(path))
    partial = path.with_name(f".{path.stem}.{secrets.token_hex(4)}{path.suffix}")
    try:
        yield partial
        partial.replace(path)
    except OSError as error:
        if error.filename == str(partial):
            error.filename = str(path)  # of which users know
        raise
    finally:
        partial.unlink(missing_ok=True)


def write_whole(path: Path, content: bytes | str) -> None:
    """Write a file, as a whole or not at all; a text in UTF-8.

    Raises
    ------
    OSError
        It cannot be written, and is named; the one before stays.
    """
    try:
        with whole(path) as partial:
            partial.write_bytes(content.encode() if isinstance(content, str) else content)
    except OSError as error:
        error.filename = error.filename or str(path)  # a full disk names none
        raise
