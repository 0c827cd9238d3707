"""How much one owner may ask for: requests a second, and jobs that have not ended."""

import math
import time
from typing import Final

from limits import RateLimitItem, RateLimitItemPerSecond
from limits.storage import MemoryStorage
from limits.strategies import FixedWindowRateLimiter

from jointplay.service.access import Caller
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import SubmissionKey
from jointplay.storage.settings import Settings

_WINDOW: Final = 10
"""Seconds in which requests are counted together: who was silent may send some at once."""


class Rates:
    """Counts the requests of owners; each process for itself.

    Parameters
    ----------
    a_second
        Requests; 0: as many as they like.
    """

    def __init__(self, a_second: float) -> None:
        self._limiter = FixedWindowRateLimiter(MemoryStorage())
        self._most: RateLimitItem | None = None
        if a_second:
            self._most = RateLimitItemPerSecond(max(round(a_second * _WINDOW), 1), _WINDOW)

    def count(self, owner: str) -> None:
        """Count a request; refuse it with 429 if there were too many."""
        if self._most is None or self._limiter.hit(self._most, owner):
            return
        window = self._limiter.get_window_stats(self._most, owner)
        seconds = max(math.ceil(window.reset_time - time.time()), 1)
        raise RequestRefused(
            kinds.TOO_MANY_REQUESTS,
            f"{owner} sent more than {self._most.amount} requests in {_WINDOW} s.",
            headers={"Retry-After": str(seconds)},
        )


def require_quota(
    caller: Caller,
    catalogue: Catalogue,
    settings: Settings,
    more: int,
    key: SubmissionKey | None,
) -> None:
    """Refuse further jobs with 403 where an owner would have too many that have not ended.

    A request that is sent again, with its key, asks for no further ones. Several requests at once
    may exceed the number by what they ask for together.
    """
    most = settings.most_live
    if not most or not caller.owner or caller.sees_all:
        return
    live = catalogue.live_jobs(caller.owner)
    if live + more > most and not catalogue.is_answered(key):
        raise RequestRefused(
            kinds.QUOTA_EXCEEDED,
            f"{caller.owner} has {live} jobs that have not ended, and may have {most};"
            f" this would be {more} more.",
        )
