"""Bytes of many requests that are in memory or on disk at once, bounded together."""

from typing import Final

from starlette.types import Scope

from jointplay.service.problems import unavailable

RETRY: Final = 5
"""Seconds after which a client that found no room may ask again."""


class Together:
    """Room for bytes that requests have until they are answered.

    Parameters
    ----------
    most
        Bytes of all of them, if they are of several requests.
    full
        A sentence for a request that finds no room.
    """

    def __init__(self, most: int, full: str) -> None:
        self.most, self.held = most, 0
        self._full = full

    def take(self, scope: Scope, size: int) -> None:
        """Make room for more of a request; RequestRefused if there is none."""
        if size and self.held and self.held + size > self.most:
            raise unavailable(self._full, RETRY)
        self.held += size
        scope[self._full] = scope.get(self._full, 0) + size

    def release(self, scope: Scope) -> None:
        """Give back what an answered request took."""
        self.held -= scope.pop(self._full, 0)
