"""PostgreSQL away for a while, and connections to it that it ends."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from tests.machines.cluster import Cluster


class DatabaseRestarted:
    """A fast shutdown, and a start."""

    lasts = (0.0, 15.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[None]:
        cluster.servers.database.stop()
        try:
            yield
        finally:
            with cluster.servers.port.inside():
                cluster.servers.database.start()


class BackendsTerminated:
    """Every connection ended, in whatever it was."""

    lasts = (0.0, 0.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[None]:
        servers = cluster.servers
        servers.database.cut(servers.environment["JOINTPLAY_CATALOGUE_URL"])
        yield
