"""Machines that others cannot reach for a while."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random

from tests.machines.cluster import Cluster
from tests.machines.machine import Machine


@dataclass(frozen=True)
class LinkCut:
    """An interface that is down, which the machine's own processes are told."""

    servers: bool = False
    lasts = (3.0, 25.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine = None if self.servers else drawn.choice(cluster.machines)
        port = cluster.servers.port if machine is None else machine.port
        port.pull_out()
        try:
            yield machine
        finally:
            port.plug_in()


@dataclass(frozen=True)
class BlackHole:
    """A network that swallows what is sent, both ways, and tells nobody."""

    servers: bool = False
    lasts = (60.0, 60.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine = None if self.servers else drawn.choice(cluster.machines)
        port = cluster.servers.port if machine is None else machine.port
        port.leave()
        try:
            yield machine
        finally:
            port.join()
