"""Which files belong to a catalogue: it and they have the same mark since they first met.

Services with other files would answer that results are gone which are whole elsewhere, and remove
what they take for left over.
"""

import logging
import secrets
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.object_stores import ObjectStore
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.settings import Settings

MARK: Final = "installation"
"""Name of the file, or object, that holds the mark."""
LINK_SIGNER: Final = "secret-of-links"
"""Name of the object with what the service signs links to results with."""
_DATA: Final = "data"
_RESULTS: Final = "results"
_LONGEST: Final = 64  # characters
_log = logging.getLogger(__name__)


class OtherFiles(Exception):
    """The files are those of another catalogue, or the catalogue is that of other files."""


def require_own_files(settings: Settings, catalogue: Catalogue) -> None:
    """Compare the marks of data folder and object store, as far as all processes share them.

    Raises
    ------
    OtherFiles
        One has another mark than the catalogue wants.
    """
    for name, store, where in _shared(settings, catalogue):
        known = catalogue.mark_of(name)
        try:
            found = _mark_in(store) or ("" if known else _marked(store))
        except OSError as error:  # readiness tells; the next start looks again
            _log.warning("%s is not compared with the catalogue: %s", where, error)
            continue
        known = known or catalogue.note_mark(name, found)
        if found != known:
            raise OtherFiles(
                f"{where} {'is of another catalogue' if found else 'is new to this catalogue'},"
                f" whose jobs have their files elsewhere; give all that share a catalogue the same"
                f" folder and results. If its files were moved or restored here, write {known} into"
                f" {where}/{MARK}"
            )


def require_reachable(settings: Settings, catalogue: Catalogue) -> None:
    """Look whether data folder and object store are there, before results are stored.

    Raises
    ------
    ConnectionError
        A disk is not mounted, which had a mark, or a server does not answer.
    """
    for name, store, where in _shared(settings, catalogue):
        if store.version(MARK) is None and catalogue.mark_of(name) is not None:
            raise ConnectionError(f"the disk with the results is not mounted at {where}")


def _shared(settings: Settings, catalogue: Catalogue) -> Iterator[tuple[str, ObjectStore, str]]:
    if not settings.sends:
        yield _DATA, Folder(str(settings.data)), str(settings.data)
    store = settings.object_store
    is_apart = not isinstance(store, Folder) or _is_apart(Path(store.root), settings.data)
    if is_apart or catalogue.mark_of(_RESULTS) is not None:
        yield _RESULTS, store, settings.results_url.partition("?")[0]


def _is_apart(results: Path, data: Path) -> bool:
    """Whether a folder is outside of the data folder, or a disk of its own is mounted there."""
    if not results.is_relative_to(data):
        return True
    with suppress(FileNotFoundError, NotADirectoryError):
        return results.stat().st_dev != data.stat().st_dev
    return False


def _mark_in(store: ObjectStore) -> str:
    """Return the mark of an object store; empty if it has none."""
    with suppress(FileNotFoundError):
        return store.read(MARK, 0, _LONGEST).decode(errors="replace").strip()
    return ""


def _marked(store: ObjectStore) -> str:
    """Mark an object store, and return the mark that it has then."""
    with suppress(FileExistsError):
        store.put(MARK, [secrets.token_hex(16).encode()])
    return _mark_in(store)
