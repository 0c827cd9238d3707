"""Clocks that are a minute ahead or behind: of a machine, of a server."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random
from typing import ClassVar, Literal

from tests.machines.clock import Clock
from tests.machines.cluster import Cluster
from tests.machines.faults.machine_killed import MachineKilled
from tests.machines.machine import Machine

_OFF = 60.0  # s


@contextmanager
def _set(clocks: list[Clock], drawn: Random) -> Iterator[None]:
    ahead = drawn.choice((-_OFF, _OFF))
    for clock in clocks:
        clock.set(ahead)
    try:
        yield
    finally:
        for clock in clocks:
            clock.set(0.0)


@dataclass(frozen=True)
class ClockSet:
    """The clock of one machine, of the database or of the broker jumps, and jumps back.

    That of the store, a program of Go, is off when those of all who sign what they ask for are.
    """

    whose: Literal["machine", "database", "broker", "store"]
    lasts: ClassVar[tuple[float, float]] = (10.0, 30.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        servers = cluster.servers
        machine = drawn.choice(cluster.machines) if self.whose == "machine" else None
        clocks = {
            "machine": [machine.clock] if machine else [],
            "database": [servers.clock],
            "broker": [servers.redis.clock],
            "store": [one.clock for one in cluster.machines],
        }
        with _set(clocks[self.whose], drawn):
            yield machine


class KilledAsClockIsSet(MachineKilled):
    """A machine loses power just as the database's clock jumps."""

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        with _set([cluster.servers.clock], drawn), super().strike(cluster, drawn) as machine:
            yield machine
