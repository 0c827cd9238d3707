"""Turns of owners at what few can have at a time: whoever asks for much keeps nobody else out."""

import threading
from collections import Counter, OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

OF_ONE: Final = 8
"""Threads of one owner in one queue, the one that has its turn included."""
MOST_EVERYWHERE: Final = 32
"""Threads in all queues: of the 40 that answer requests some are left for what takes no time. No
owner has more of them than are left: the first half of them, the next one a quarter, and so on."""


class Full(Exception):
    """An owner has as many in a queue as one may have, or all owners together."""


class FairQueue:
    """Gives slots to threads: to one of an owner at a time, and to owners in turn."""

    _lock = threading.Lock()  # of all queues, as they share the room
    _everywhere: Counter[str] = Counter()

    def __init__(self, slots: int) -> None:
        self._changed = threading.Condition(self._lock)
        self._free = [*range(slots)]
        self._waiting: OrderedDict[str, list[object]] = OrderedDict()
        self._served: set[str] = set()

    @contextmanager
    def slot(self, owner: str) -> Iterator[int]:
        """Wait for a slot, and yield its number; Full if there is no room to wait."""
        me = object()
        with self._changed:
            self._enter(owner, me)
            self._changed.wait_for(lambda: self._is_next(owner, me))
            slot = self._take(owner)
        try:
            yield slot
        finally:
            with self._changed:
                self._leave(owner, slot)

    def waiting(self) -> int:
        """Return how many wait for a slot."""
        with self._lock:
            return sum(map(len, self._waiting.values()))

    def _enter(self, owner: str, one: object) -> None:
        own = len(self._waiting.get(owner, ())) + (owner in self._served)
        left = MOST_EVERYWHERE - self._everywhere.total()
        if own >= OF_ONE or self._everywhere[owner] >= left:
            raise Full
        self._everywhere[owner] += 1
        self._waiting.setdefault(owner, []).append(one)

    def _is_next(self, owner: str, one: object) -> bool:
        if not self._free or self._waiting[owner][0] is not one:
            return False
        return owner == next((name for name in self._waiting if name not in self._served), None)

    def _take(self, owner: str) -> int:
        self._served.add(owner)
        self._waiting.move_to_end(owner)
        self._waiting[owner].pop(0)
        if not self._waiting[owner]:
            del self._waiting[owner]
        slot: int = min(self._free)
        self._free.remove(slot)
        self._changed.notify_all()  # another slot may be free for the next owner
        return slot

    def _leave(self, owner: str, slot: int) -> None:
        self._served.remove(owner)
        self._free.append(slot)
        self._everywhere[owner] -= 1
        if not self._everywhere[owner]:
            del self._everywhere[owner]
        self._changed.notify_all()
