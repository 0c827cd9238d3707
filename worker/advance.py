"""When an attempt at a block last moved on: what it computes, and what it stores or sends."""

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.taken import heard


class Advance:
    """Heard by the lease; noted by whatever takes long, from any thread."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def note(self) -> None:
        """Note that the attempt moved on."""
        self._last = time.monotonic()

    def age(self) -> float:
        """Return the seconds since the attempt last moved on."""
        return time.monotonic() - self._last


def noted(pieces: Iterable[bytes], note: Callable[[], None]) -> Iterator[bytes]:
    """Give the pieces of what is stored, each of which counts as moving on."""
    for piece in pieces:
        note()
        yield piece
    note()


@dataclass(frozen=True)
class _Noted(StoredObject):
    """An object whose `put` moves on with each piece."""

    target: StoredObject
    note: Callable[[], None]

    def put(self, pieces: Iterable[bytes]) -> None:
        """See `ObjectStore.put`."""
        with heard(self.note):
            self.target.put(noted(pieces, self.note))


def noted_target(target: StoredObject, note: Callable[[], None]) -> StoredObject:
    """Return a target whose `put` notes each piece."""
    return _Noted(target.object_store, target.key, target, note)
