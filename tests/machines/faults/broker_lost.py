"""A Redis that ends and is started anew, empty."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from tests.machines.cluster import Cluster


class BrokerLost:
    """SIGKILL, and a start."""

    lasts = (0.0, 15.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[None]:
        cluster.servers.redis.kill()
        try:
            yield
        finally:
            cluster.servers.redis.start()
