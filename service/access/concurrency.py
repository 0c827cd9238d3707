"""Requests at once, bounded; those that keep the service and its workers going have a reserve.

Callers without a key cannot have all: a key counts only where it is looked at.
"""

import re
from collections import Counter
from collections.abc import Sequence
from contextlib import ExitStack
from typing import Final

from starlette.requests import Request
from starlette.routing import BaseRoute, Match
from starlette.types import ASGIApp, Receive, Scope, Send

from jointplay.service.owners import UNTIL_ANSWERED, VITAL
from jointplay.service.problems import unavailable
from jointplay.service.problems.handlers import answer

MOST: Final = 512
"""Requests at once, those that wait or stream included."""
OF_WORKERS: Final = 32
"""Requests of these that only workers with a block, and health, may have."""
OF_HEALTH: Final = 16
"""Further ones that only health and readiness may have: they read no bodies."""
WITHOUT_KEY: Final = 208
"""Requests without a key at once where none is required: 200 workers that wait, and some."""
BESIDE_KEYS: Final = 64
"""Requests without a key at once where one is required. Who sends one that is wrong is refused
before anything is read of the body, and holds nothing."""
RETRY: Final = 5
"""Seconds after which a refused client may ask again."""
_HEALTH: Final = re.compile(r"/(healthz|readyz)")


class ConcurrencyLimit:
    """Refuses requests beyond the bound with 503.

    Parameters
    ----------
    unlocked
        Routes of the API that nobody needs a key for.
    keys
        Whether all others need one.
    """

    def __init__(self, app: ASGIApp, unlocked: Sequence[BaseRoute], *, keys: bool) -> None:
        self._app, self._unlocked = app, unlocked
        self._without_key = BESIDE_KEYS if keys else WITHOUT_KEY
        self._running: Counter[bool] = Counter()  # with a key, and without

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on while there is room for it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        has_key = self._shows_key(scope)
        if not self._has_room(scope["path"], has_key=has_key):
            refused = unavailable("The service answers as many requests as it can.", RETRY)
            response = await answer(Request(scope), refused)
            await response(scope, receive, send)
            return
        self._running[has_key] += 1
        try:
            with ExitStack() as held:
                scope[UNTIL_ANSWERED] = held
                await self._app(scope, receive, send)
        finally:
            self._running[has_key] -= 1

    def _shows_key(self, scope: Scope) -> bool:
        """Whether a request has a key, at an address where it is looked at first of all."""
        return (
            any(name == b"authorization" for name, _ in scope["headers"])
            and scope["path"].startswith("/v1/")
            and all(route.matches(scope)[0] is not Match.FULL for route in self._unlocked)
        )

    def _has_room(self, path: str, *, has_key: bool) -> bool:
        running = self._running.total()
        if _HEALTH.fullmatch(path):
            return running < MOST
        if VITAL.fullmatch(path):
            return running < MOST - OF_HEALTH
        others = MOST - OF_HEALTH - OF_WORKERS
        return running < others and (has_key or self._running[False] < self._without_key)
