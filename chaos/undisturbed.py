"""The same jobs computed without any fault: the bytes that a service must have stored."""

import json
from pathlib import Path
from typing import Final

from jointplay.chaos.jobs import Document
from jointplay.solver.kinds import admit
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.results.layout import MANIFEST
from jointplay.worker.local.computing import compute
from jointplay.worker.local.folder import STORE

_ROOT: Final = "zarr.json"
_MEASURED_COSTS: Final = "statistics/seconds/c/0"
"""Seconds that methods took, in an accuracy study."""


def undisturbed(job: Document, folder: Path) -> dict[str, bytes]:
    """Compute a job in this process and return the files of its sealed store."""
    folder.mkdir()
    compute(admit(dict(job)), folder, 1, _nothing)
    return files_of(StoredObject(Folder(str(folder)), STORE))


def files_of(sealed: StoredObject) -> dict[str, bytes]:
    """Return every file of a sealed store with its bytes, but for times that were measured.

    The manifest, which has their digests, is left out: it is verified against its own store.
    """
    store = Packed(sealed)
    files = {key: store.read(key) for key in store if key not in (_MEASURED_COSTS, MANIFEST)}
    document = json.loads(files[_ROOT])
    document["attributes"].get("summary", {}).pop("solver_seconds", None)
    return files | {_ROOT: json.dumps(document).encode()}


def _nothing(_fraction: float, _note: str) -> None:
    """Report no progress."""
