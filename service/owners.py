"""Whose request is answered, and what one owner may have of all requests at once."""

import re
from collections import Counter
from contextlib import ExitStack
from contextvars import ContextVar
from typing import Final

from starlette.types import Scope

from jointplay.service.problems import RequestRefused, kinds

OWNER: ContextVar[str] = ContextVar("owner", default="")
"""Owner of the key of the request that is answered; empty where none is asked for."""
VITAL: Final = re.compile(
    r"/(healthz|readyz|v1/worker/blocks/[^/]+/[^/]+/(heartbeat|progress|checkpoint|finish|cut-off))"
)
"""Paths that keep the service and its workers going."""
UNTIL_ANSWERED: Final = "jointplay.until-answered"
"""Where a request's scope has the `ExitStack` that is closed once it is answered."""
OF_ONE: Final = 208
"""Requests of one owner at once: 200 workers that wait for blocks, and some."""
WAITING: Final = 128
"""Those of them that stream a job's events, or wait for its end."""
RETRY: Final = 5
"""Seconds after which an owner who has so many may ask again."""


class Shares:
    """Counts what owners have at the moment."""

    def __init__(self) -> None:
        self._asked: Counter[str] = Counter()
        self._vital: Counter[str] = Counter()  # apart, so that the others keep no worker waiting
        self._waiting: Counter[str] = Counter()

    def enter(self, scope: Scope, owner: str) -> None:
        """Count an owner's request until it is answered; 429 if there are too many."""
        asked = self._vital if VITAL.fullmatch(scope["path"]) else self._asked
        if asked[owner] >= OF_ONE:
            raise _refusal(f"{owner} has {OF_ONE} requests at once.")
        _count(asked, scope, owner)

    def wait(self, scope: Scope) -> bool:
        """Count a request that streams or waits, until it is answered; False: too many do."""
        owner = OWNER.get()
        if self._waiting[owner] >= WAITING:
            return False
        _count(self._waiting, scope, owner)
        return True

    def must_wait(self, scope: Scope) -> None:
        """Count a request as `wait` does, or refuse it with 429."""
        if not self.wait(scope):
            whose = f" of {OWNER.get()}" if OWNER.get() else ""
            raise _refusal(f"{WAITING} requests{whose} wait for jobs, or stream their events.")


SHARES: Final = Shares()


def _count(counter: Counter[str], scope: Scope, owner: str) -> None:
    def leave() -> None:
        counter[owner] -= 1
        if not counter[owner]:
            del counter[owner]

    held: ExitStack = scope[UNTIL_ANSWERED]
    counter[owner] += 1
    held.callback(leave)


def _refusal(sentence: str) -> RequestRefused:
    return RequestRefused(kinds.TOO_MANY_REQUESTS, sentence, headers={"Retry-After": str(RETRY)})
