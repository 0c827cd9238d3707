"""Limit of one owner's requests a second."""

import logging
import math
import time
from typing import Final

from fastapi.concurrency import run_in_threadpool
from limits import RateLimitItem, RateLimitItemPerSecond
from limits.storage import MemoryStorage, RedisStorage
from limits.strategies import MovingWindowRateLimiter
from redis.exceptions import RedisError

from jointplay.service.problems import RequestRefused, kinds

_WINDOW: Final = 10
"""Seconds, of which the last ones are counted: who was silent may send some at once."""
_PATIENCE: Final = 0.5  # s a request waits for Redis
_ASK_AGAIN: Final = 5.0  # s after which a Redis that did not answer is asked again
_log = logging.getLogger(__name__)


class Rates:
    """Counts the requests of owners, in Redis for all APIs together.

    Without Redis, and while it does not answer, each process counts for itself.

    Parameters
    ----------
    a_second
        Requests; 0: as many as they like.
    """

    def __init__(self, a_second: float, redis_url: str | None) -> None:
        self._own = MovingWindowRateLimiter(MemoryStorage())
        self._shared: MovingWindowRateLimiter | None = None
        self._ask_at = 0.0
        self._most: RateLimitItem | None = None
        if a_second:
            self._most = RateLimitItemPerSecond(max(round(a_second * _WINDOW), 1), _WINDOW)
            if redis_url is not None:
                storage = RedisStorage(
                    redis_url,
                    key_prefix="jointplay:rates",
                    socket_timeout=_PATIENCE,
                    socket_connect_timeout=_PATIENCE,
                )
                self._shared = MovingWindowRateLimiter(storage)

    async def count(self, owner: str) -> None:
        """Count a request; refuse it with 429 if there were too many."""
        if self._most is None:
            return
        if self._shared is not None and time.monotonic() >= self._ask_at:
            try:
                await run_in_threadpool(_count, self._shared, self._most, owner)
                return
            except RedisError as error:
                self._ask_at = time.monotonic() + _ASK_AGAIN
                _log.warning("requests are counted by this process alone: %s", error)
        _count(self._own, self._most, owner)


def _count(limiter: MovingWindowRateLimiter, most: RateLimitItem, owner: str) -> None:
    if not limiter.hit(most, owner):
        window = limiter.get_window_stats(most, owner)
        seconds = max(math.ceil(window.reset_time - time.time()), 1)
        raise RequestRefused(
            kinds.TOO_MANY_REQUESTS,
            f"{owner} sent more than {most.amount} requests in {_WINDOW} s.",
            headers={"Retry-After": str(seconds)},
        )
