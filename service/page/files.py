"""Files of the page: what may be asked for, its media type and its digest."""

import hashlib
import json
import logging
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Final, NamedTuple

import jointplay.page
from jointplay.records.joint_marks import MARKS

_log = logging.getLogger(__name__)
MEDIA_TYPES: Final = {
    "html": "text/html; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "svg": "image/svg+xml",
    "ico": "image/x-icon",
    "txt": "text/plain; charset=utf-8",
}
"""Media types by the end of a name; other files are not served."""
VERSION_LENGTH: Final = 16
"""Hexadecimal digits of a version."""
FOLDER: Final = Path(next(iter(jointplay.page.__path__)))
_ADDRESS: Final = b'"/page/'
_MARKS: Final = "mechanism/joint_marks.js"
"""A module that is made here: the marks by which types of joints are drawn."""


@dataclass(frozen=True)
class PageFile:
    """One file as it is sent."""

    content: bytes
    media_type: str
    digest: str
    """SHA-256 of the content, its entity tag."""


class _Entry(NamedTuple):
    """A file that is served: its name, such as ``style/base.css``, and when it changed [ns]."""

    name: str
    changed: int
    size: int


def page_file(name: str, folder: Path = FOLDER) -> PageFile | None:
    """Return a file, or None where there is none of this name: names are looked up, not opened.

    HTML names the other files with the version of all of them.
    """
    if name == _MARKS:
        return _file(_marks(), MEDIA_TYPES["js"])
    found = tuple(_listed(folder))
    if name not in {entry.name for entry in found}:
        return None
    content = (folder / name).read_bytes()
    if name.endswith(".html"):
        content = content.replace(_ADDRESS, _ADDRESS + _digest(folder, found).encode() + b"/")
    return _file(content, MEDIA_TYPES[name.rpartition(".")[2]])


def version(folder: Path = FOLDER) -> str:
    """Return what changes whenever a file of the page does; equal files have equal versions."""
    return _digest(folder, tuple(_listed(folder)))


def report_file(path: Path | None) -> PageFile | None:
    """Return the report that the operator names, or None where there is none to read."""
    try:
        return None if path is None else _file(path.read_bytes(), MEDIA_TYPES["html"])
    except OSError as error:
        _log.warning("the report is not shown: %s", error)
        return None


def _marks() -> bytes:
    return f"export const MARKS = {json.dumps(MARKS)};\n".encode()


def _file(content: bytes, media_type: str) -> PageFile:
    return PageFile(content, media_type, hashlib.sha256(content).hexdigest())


def _listed(folder: str | Path, prefix: str = "") -> Iterator[_Entry]:
    """Yield the files that are served; `scandir`, since this is done for each answer."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir():
                yield from _listed(entry.path, f"{prefix}{entry.name}/")
            elif entry.name.rpartition(".")[2] in MEDIA_TYPES:
                seen = entry.stat()
                yield _Entry(f"{prefix}{entry.name}", seen.st_mtime_ns, seen.st_size)


@lru_cache(maxsize=1)
def _digest(folder: Path, entries: tuple[_Entry, ...]) -> str:
    """Return the digest of names and contents; `entries` tell whether any has changed."""
    whole = hashlib.sha256(_marks())
    for name in sorted(entry.name for entry in entries):
        whole.update(name.encode() + b"\0" + hashlib.sha256((folder / name).read_bytes()).digest())
    return whole.hexdigest()[:VERSION_LENGTH]
