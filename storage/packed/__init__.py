"""A store in one file: an uncompressed zip of its keys, which stock Zarr opens in place.

`pack` gives the bytes of such a file, `Packed` finds the keys in one. Sealed results are packed
files with a manifest; what a running store finished is in packed files without one.
"""

from pathlib import Path

from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed.reading import Files, Packed
from jointplay.storage.packed.running import Running
from jointplay.storage.packed.writing import pack

__all__ = ["Files", "Packed", "Running", "files_at", "pack"]


def files_at(path: Path) -> Files:
    """Return the files of a store on this machine: packed, or a folder that is being filled.

    Raises
    ------
    NotAStore
        There is none.
    """
    if path.is_dir():
        return Running(path)
    return Packed(StoredObject(Folder(str(path.parent)), path.name))
