"""Wake-ups between processes: a committed job wakes the relay through Redis pub/sub.

Only latency depends on them: a lost wake-up costs the relay's polling period, never a job.
"""

import logging
import threading
import time
from functools import lru_cache
from typing import Self

from redis import Redis
from redis.exceptions import RedisError

CHANNEL = "jointplay:wake-up"
_PATIENCE = 2.0  # seconds a thread of ours waits for Redis
_log = logging.getLogger(__name__)


def connection(redis_url: str) -> Redis:
    """Return a connection to Redis whose commands wait for two seconds at most."""
    return Redis.from_url(redis_url, socket_timeout=_PATIENCE, socket_connect_timeout=_PATIENCE)


class WakeUpPublisher:
    """Publishes from a thread of its own, so that no request ever waits for Redis."""

    def __init__(self, redis_url: str) -> None:
        self._redis = connection(redis_url)
        self._asked = threading.Event()
        threading.Thread(target=self._publish_when_asked, name="wake-up", daemon=True).start()

    def publish(self) -> None:
        """Ask for a wake-up and return at once; asking twice may send one."""
        self._asked.set()

    def _publish_when_asked(self) -> None:
        while True:
            self._asked.wait()
            self._asked.clear()
            try:
                self._redis.publish(CHANNEL, b"")
            except RedisError as error:
                _log.debug("no wake-up was sent, the relay will look by itself: %s", error)


@lru_cache(maxsize=1)
def _publisher(redis_url: str) -> WakeUpPublisher:
    return WakeUpPublisher(redis_url)


def wake_relay(redis_url: str | None) -> None:
    """Wake the relay, because there are new blocks. Returns at once and never raises."""
    if redis_url is not None:
        _publisher(redis_url).publish()


class WakeUpListener:
    """Waits for wake-ups, in the relay."""

    def __init__(self, redis_url: str) -> None:
        self._redis = connection(redis_url)
        self._listening = self._redis.pubsub(ignore_subscribe_messages=True)  # type: ignore[no-untyped-call]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._listening.close()
        self._redis.close()

    def wait(self, seconds: float) -> None:
        """Return at a wake-up, or after `seconds`; without Redis just wait."""
        deadline = time.monotonic() + seconds
        try:
            if not self._listening.subscribed:
                self._listening.subscribe(CHANNEL)
            while (left := deadline - time.monotonic()) > 0:
                if self._listening.get_message(timeout=left) is not None:
                    break
            while self._listening.get_message(timeout=0) is not None:
                pass  # several wake-ups are one
        except RedisError as error:
            _log.debug("cannot listen for wake-ups: %s", error)
            self._listening.reset()
            time.sleep(max(deadline - time.monotonic(), 0))
