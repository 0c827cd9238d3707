"""Last parts of blocks that this process has read: of a million points there are two thousand.

A last part never changes. Reading them all for each look at a growing map would take seconds.
"""

from collections import OrderedDict
from collections.abc import Hashable
from threading import Lock
from typing import Final

from jointplay.storage.packed import Running
from jointplay.storage.studies.examined_part import sound_part
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.part import Part, is_last

MOST_BYTES: Final = 256_000_000


class KeptParts:
    """Parts by their files as they are now; those that were not asked for longest go first."""

    def __init__(self, most: int = MOST_BYTES) -> None:
        self._most, self._bytes = most, 0
        self._parts: OrderedDict[tuple[Hashable, str], Part] = OrderedDict()
        self._lock = Lock()

    def read(self, files: Running, name: str, digest: str, layout: StudyLayout) -> Part:
        """Return a part as `sound_part` does; of one that is kept nobody changes anything."""
        stamp = files.stamp(name) if is_last(name) else None
        key = stamp, digest
        with self._lock:
            found = None if stamp is None else self._parts.get(key)
            if found is not None:
                self._parts.move_to_end(key)
                return found
        found = sound_part(files, name, digest, layout)
        if stamp is not None:
            self._keep(key, found)
        return found

    def _keep(self, key: tuple[Hashable, str], part: Part) -> None:
        with self._lock:
            if key not in self._parts:
                self._parts[key] = part
                self._bytes += part.nbytes
            while self._bytes > self._most:
                _, gone = self._parts.popitem(last=False)
                self._bytes -= gone.nbytes


KEPT_PARTS: Final = KeptParts()
