"""Machines that others cannot reach for a while."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random
from typing import Literal, NamedTuple

from tests.machines.cluster import Cluster
from tests.machines.machine import Machine
from tests.machines.network import Port


class Way(NamedTuple):
    """A way in which a port is cut off, and comes back; shortest and longest time [s]."""

    begin: Callable[[Port], None]
    end: Callable[[Port], None]
    lasts: tuple[float, float]


LINK_CUT = Way(Port.pull_out, Port.plug_in, (3.0, 25.0))
"""An interface that is down, which the machine's own processes are told."""
BLACK_HOLE = Way(Port.leave, Port.join, (60.0, 60.0))
"""A network that swallows what is sent, both ways, and tells nobody."""


@dataclass(frozen=True)
class Unreachable:
    """One machine with an API, that which joined, the servers, or the bucket's door, cut off."""

    way: Way
    who: Literal["own", "joined", "servers", "door"] = "own"

    @property
    def lasts(self) -> tuple[float, float]:
        return self.way.lasts

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine: Machine | None = cluster.joined
        if self.who == "own":
            machine = drawn.choice(cluster.own)
        elif self.who == "servers":
            machine = None
        port = cluster.servers.port if machine is None else machine.port
        if self.who == "door":  # to which only those who joined go
            port = cluster.door.port
        self.way.begin(port)
        try:
            yield machine
        finally:
            self.way.end(port)
