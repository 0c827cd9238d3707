"""Limit of one owner's requests a second."""

import logging
import math
import secrets
import time
from collections import defaultdict, deque
from collections.abc import Callable
from typing import Final

from fastapi.concurrency import run_in_threadpool
from redis import Redis
from redis.exceptions import RedisError

from jointplay.service.problems import RequestRefused, kinds

_WINDOW: Final = 10.0
"""Seconds, of which the last ones are counted: who was silent may send some at once."""
_PATIENCE: Final = 0.5  # s a request waits for Redis
_ASK_AGAIN: Final = 5.0  # s after which a Redis that did not answer is asked again
_KEY: Final = "jointplay:rates:"
_COUNT: Final = """
local moment = redis.call('TIME')
local now, window = moment[1] + moment[2] / 1e6, tonumber(ARGV[2])
redis.call('ZREMRANGEBYSCORE', KEYS[1], '-inf', string.format('(%.6f', now - window))
redis.call('ZREMRANGEBYSCORE', KEYS[1], string.format('(%.6f', now), '+inf')  -- it was set back
if redis.call('ZCARD', KEYS[1]) >= tonumber(ARGV[1]) then
  local first = redis.call('ZRANGE', KEYS[1], 0, 0, 'WITHSCORES')[2]
  return string.format('%.6f', first + window - now)
end
redis.call('ZADD', KEYS[1], string.format('%.6f', now), ARGV[3])
redis.call('EXPIRE', KEYS[1], window + 1)
return '0'
"""
"""Counts a request of an owner by the clock of Redis, of which all APIs hear the same."""
_log = logging.getLogger(__name__)


class Rates:
    """Counts the requests of owners, in Redis for all APIs together.

    Without Redis, and while it does not answer, each process counts for itself.

    Parameters
    ----------
    a_second
        Requests; 0: as many as they like.
    clock
        Of this process, which nobody sets, s.
    """

    def __init__(
        self, a_second: float, redis_url: str | None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._most = max(round(a_second * _WINDOW), 1) if a_second else 0
        self._clock = clock
        self._own: defaultdict[str, deque[float]] = defaultdict(deque)
        self._redis: Redis | None = None
        self._ask_at = 0.0
        if self._most and redis_url is not None:
            self._redis = Redis.from_url(
                redis_url, socket_timeout=_PATIENCE, socket_connect_timeout=_PATIENCE
            )

    async def count(self, owner: str) -> None:
        """Count a request; refuse it with 429 if there were too many."""
        if not self._most:
            return
        seconds = await self._shared_wait(owner)
        if seconds is None:
            seconds = self._own_wait(owner)
        if seconds > 0.0:
            raise RequestRefused(
                kinds.TOO_MANY_REQUESTS,
                f"{owner} sent more than {self._most} requests in {_WINDOW:g} s.",
                headers={"Retry-After": str(math.ceil(seconds))},
            )

    async def _shared_wait(self, owner: str) -> float | None:
        """Count in Redis, and return the seconds until there is room; None: it does not answer."""
        if self._redis is None or time.monotonic() < self._ask_at:
            return None
        given = (1, f"{_KEY}{owner}", str(self._most), str(_WINDOW), secrets.token_hex(8))
        try:
            return float(await run_in_threadpool(self._redis.eval, _COUNT, *given))
        except RedisError as error:
            self._ask_at = time.monotonic() + _ASK_AGAIN
            _log.warning("requests are counted by this process alone: %s", error)
            return None

    def _own_wait(self, owner: str) -> float:
        """Count here, and return the same."""
        now, counted = self._clock(), self._own[owner]
        while counted and counted[0] < now - _WINDOW:
            counted.popleft()
        if len(counted) >= self._most:
            return counted[0] + _WINDOW - now
        counted.append(now)
        return 0.0
