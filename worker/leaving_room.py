"""Sealing that leaves some of the disk to the catalogue.

What was computed is on the disk already, and is removed once it is sealed. So that jobs can end on
a disk that is nearly full, sealing may take half of the reserve that computing leaves free.
"""

import errno
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.settings import Settings


@dataclass(frozen=True)
class _LeavingRoom(StoredObject):
    """An object on the disk of the data folder."""

    settings: Settings

    def put(self, pieces: Iterable[bytes]) -> None:
        """See `ObjectStore.put`; OSError, too, where half of the reserve would not stay free."""
        super().put(self._looked_at(pieces))

    def _looked_at(self, pieces: Iterable[bytes]) -> Iterator[bytes]:
        settings = self.settings
        for piece in pieces:
            if settings.room() + settings.reserve // 2 < len(piece):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(settings.data))
            yield piece


def leaving_room(target: StoredObject, settings: Settings) -> StoredObject:
    """Return a target whose `put` leaves half of the reserve to the catalogue.

    The target itself where it is on no disk that they share.
    """
    store = target.object_store
    if isinstance(store, Folder) and _disk(Path(store.root)) == _disk(settings.data):
        return _LeavingRoom(store, target.key, settings)
    return target


def _disk(folder: Path) -> int | None:
    """Return the number of the disk of a folder, or of the one in which it would be made."""
    for one in (folder, *folder.parents):
        with suppress(FileNotFoundError, NotADirectoryError):
            return one.stat().st_dev
    return None
