"""Bytes of many requests that are in memory or on disk at once, bounded together."""

from collections import Counter
from typing import Final

from starlette.types import Scope

from jointplay.service.owners import OWNER, UNTIL_ANSWERED
from jointplay.service.problems import unavailable

RETRY: Final = 5
"""Seconds after which a client that found no room may ask again."""


class ByteBudget:
    """Room for bytes that requests have until they are answered.

    No owner has more of it than is left: one who takes all that is to be had leaves half to others.

    Parameters
    ----------
    most
        Bytes of all of them, if they are of several requests.
    full
        A sentence for a request that finds no room.
    """

    def __init__(self, most: int, full: str) -> None:
        self.most = most
        self._full = full
        self._held: Counter[str] = Counter()

    @property
    def held(self) -> int:
        """Bytes that are taken."""
        return self._held.total()

    def take(self, scope: Scope, size: int) -> None:
        """Make room for more of a request until it is answered; RequestRefused if there is none."""
        owner = OWNER.get()
        own = self._held[owner] if owner else 0
        if size and self.held and own + size > self.most - self.held:
            raise unavailable(self._full, RETRY)
        if self._full not in scope:
            scope[UNTIL_ANSWERED].callback(self._release, scope, owner)
        self._held[owner] += size
        scope[self._full] = scope.get(self._full, 0) + size

    def _release(self, scope: Scope, owner: str) -> None:
        self._held[owner] -= scope[self._full]
        if not self._held[owner]:
            del self._held[owner]
