"""The relay's bell: whoever commits a job rings it, so that a worker hears of it at once.

Ringing is a courtesy. A ring that gets lost costs the relay's polling period, never a job.
"""

import logging
import threading
import time
from functools import lru_cache
from typing import Self

from redis import Redis
from redis.exceptions import RedisError

CHANNEL = "jointplay:bell"
_PATIENCE = 2.0  # seconds a thread of ours waits for Redis
_log = logging.getLogger(__name__)


class Bell:
    """Rings through Redis from a thread of its own, so that no request ever waits for Redis."""

    def __init__(self, redis_url: str) -> None:
        self._redis = Redis.from_url(
            redis_url, socket_timeout=_PATIENCE, socket_connect_timeout=_PATIENCE
        )
        self._asked = threading.Event()
        threading.Thread(target=self._ring_when_asked, name="bell", daemon=True).start()

    def ring(self) -> None:
        """Ask for a ring and return at once; asking twice may ring once."""
        self._asked.set()

    def _ring_when_asked(self) -> None:
        while True:
            self._asked.wait()
            self._asked.clear()
            try:
                self._redis.publish(CHANNEL, b"")
            except RedisError as error:
                _log.debug("the bell did not ring, the relay will look by itself: %s", error)


@lru_cache(maxsize=1)
def _bell(redis_url: str) -> Bell:
    return Bell(redis_url)


def wake_relay(redis_url: str | None) -> None:
    """Tell the relay that there are new blocks; returns at once and never raises."""
    if redis_url is not None:
        _bell(redis_url).ring()


class Doorman:
    """The relay's ear at the bell."""

    def __init__(self, redis_url: str) -> None:
        self._redis = Redis.from_url(
            redis_url, socket_timeout=_PATIENCE, socket_connect_timeout=_PATIENCE
        )
        self._listening = self._redis.pubsub(ignore_subscribe_messages=True)  # type: ignore[no-untyped-call]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._listening.close()
        self._redis.close()

    def wait(self, seconds: float) -> None:
        """Return when the bell rings, or after so many seconds; without Redis just wait."""
        deadline = time.monotonic() + seconds
        try:
            if not self._listening.subscribed:
                self._listening.subscribe(CHANNEL)
            while (left := deadline - time.monotonic()) > 0:
                if self._listening.get_message(timeout=left) is not None:
                    break
            while self._listening.get_message(timeout=0) is not None:
                pass  # several rings are one
        except RedisError as error:
            _log.debug("cannot hear the bell: %s", error)
            self._listening.reset()
            time.sleep(max(deadline - time.monotonic(), 0))
