"""Messages in Redis that wake workers for blocks that are not in the catalogue."""

import json
from base64 import b64decode
from collections.abc import Iterator, Sequence
from functools import partial

from redis import Redis
from redis.exceptions import RedisError

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import QUEUES
from jointplay.storage.reconciliation import Finding
from jointplay.storage.settings import Settings
from jointplay.worker.app import KEY_PREFIX
from jointplay.worker.socket_url import socket_url
from jointplay.worker.wake_up import connection

WHERE = "broker"


def stray_messages(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Look at all messages that no worker has taken yet; workers would drop these."""
    own = settings.data / "broker" / "redis.sock"
    if settings.redis_url is None and not own.exists():
        return
    redis = connection(settings.redis_url or socket_url(own))
    try:
        for queue in QUEUES:
            yield from _in_queue(redis, f"{KEY_PREFIX}{queue}", catalogue)
    except RedisError as error:
        if settings.redis_url is not None:  # our own one runs only while the service does
            yield Finding(
                WHERE,
                ("JOINTPLAY_REDIS_URL",),
                f"does not answer: {error}",
                advice="start it; jobs wait meanwhile",
            )
    finally:
        redis.close()


def _in_queue(redis: Redis, key: str, catalogue: Catalogue) -> Iterator[Finding]:
    messages = {message: _block_in(message) for message in redis.lrange(key, 0, -1)}
    known = catalogue.known_blocks([*messages.values()])
    strays = [message for message, block in messages.items() if block not in known]
    if strays:
        yield Finding(
            WHERE,
            tuple(f"message for {messages[message] or 'nothing'}" for message in strays),
            "wakes workers for a block that there is not",
            "removed",
            mend=partial(_remove, redis, key, strays),
        )


def _block_in(message: bytes | str) -> str:
    """Return the id of the block that a message of Celery's names; empty if it names none."""
    try:
        arguments, *_ = json.loads(b64decode(json.loads(message)["body"]))
        return str(arguments[0])
    except (ValueError, KeyError, IndexError, TypeError):
        return ""


def _remove(redis: Redis, key: str, messages: Sequence[bytes | str]) -> None:
    for message in messages:
        redis.execute_command("LREM", key, 0, message)  # type: ignore[no-untyped-call]
