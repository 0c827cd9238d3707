"""Files of the page: what may be asked for, its media type and its digest."""

import hashlib
import logging
from dataclasses import dataclass
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Final

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


@dataclass(frozen=True)
class PageFile:
    """One file as it is sent."""

    content: bytes
    media_type: str
    digest: str
    """SHA-256 of the content, its entity tag."""


def names() -> dict[str, Traversable]:
    """Return the files that are served by their names, such as ``style/base.css``."""
    found: dict[str, Traversable] = {}

    def collect(folder: Traversable, prefix: str) -> None:
        for entry in folder.iterdir():
            if entry.is_dir():
                collect(entry, f"{prefix}{entry.name}/")
            elif entry.name.rpartition(".")[2] in MEDIA_TYPES:
                found[f"{prefix}{entry.name}"] = entry

    collect(resources.files("jointplay.page"), "")
    return found


def page_file(name: str) -> PageFile | None:
    """Return a file, or None where there is none of this name: names are looked up, not opened."""
    found = names().get(name)
    if found is None:
        return None
    return _read(found, MEDIA_TYPES[name.rpartition(".")[2]])


def report_file(path: Path | None) -> PageFile | None:
    """Return the report that the operator names, or None where there is none to read."""
    try:
        return None if path is None else _read(path, MEDIA_TYPES["html"])
    except OSError as error:
        _log.warning("the report is not shown: %s", error)
        return None


def _read(file: Traversable, media_type: str) -> PageFile:
    content = file.read_bytes()
    return PageFile(content, media_type, hashlib.sha256(content).hexdigest())
