"""A broker that forgets everything and does not answer for a while."""

import contextlib
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from redis import Redis
from redis.exceptions import RedisError

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation


class BrokerWiped(Fault):
    """FLUSHALL, then SIGSTOP, later SIGCONT."""

    lasts = (5.0, 45.0)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Wipe and stop, and let go on."""
        with contextlib.suppress(RedisError), Redis.from_url(installation.broker_url) as redis:
            redis.flushall()
        brokers = installation.running("broker")
        for broker in brokers:
            broker.send(signal.SIGSTOP)
        try:
            yield
        finally:
            for broker in brokers:
                broker.send(signal.SIGCONT)
