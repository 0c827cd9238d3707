"""Files that outlive a power cut: whole under their name, or not there."""

import os
import secrets
from collections.abc import Iterable
from pathlib import Path
from typing import Final

PARTIAL: Final = ".partial"
"""Suffix of a file that is still being written."""


def write(path: Path, pieces: Iterable[bytes], *, lasting: bool = True) -> None:
    """Write a file, in place of one that may be there; durable on return if it is to be `lasting`.

    Raises
    ------
    OSError
        It cannot be written, for example because the disk is full; nothing is left of it.
    """
    partial = draft(path, pieces, lasting=lasting)
    try:
        os.replace(partial, path)
    except OSError:  # a folder has the name
        partial.unlink(missing_ok=True)
        raise
    if lasting:
        sync(path.parent)


def draft(path: Path, pieces: Iterable[bytes], *, lasting: bool = True) -> Path:
    """Write a file's content beside its name and return the path; the caller names it.

    Several processes may do so at once: each has a partial file of its own.
    """
    partial = path.with_name(f"{path.name}.{secrets.token_hex(4)}{PARTIAL}")
    try:
        with partial.open("xb", buffering=2**20) as file:
            file.writelines(pieces)
            if lasting:
                file.flush()
                os.fsync(file.fileno())
    except BaseException:
        partial.unlink(missing_ok=True)
        raise
    return partial


def make_folder(folder: Path) -> None:
    """Make a folder and those above it; their names are durable on return."""
    if folder.is_dir():
        return
    make_folder(folder.parent)
    try:
        folder.mkdir()
    except FileExistsError:
        if not folder.is_dir():  # no object of this name is there, but a file in its way
            raise NotADirectoryError(f"{folder} is a file; results need a folder there") from None
    sync(folder.parent)


def sync(path: Path) -> None:
    """Wait until the content of a file, or the names in a folder, are on the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
