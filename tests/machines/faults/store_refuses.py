"""An S3 server that answers every request with 503."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from tests.machines.cluster import Cluster


class StoreRefuses:
    """For longer than the client tries again by itself."""

    lasts = (5.0, 60.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[None]:
        cluster.servers.gate.refuse()
        try:
            yield
        finally:
            cluster.servers.gate.pass_on()
