"""A machine that loses power, and its disks with it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random
from typing import ClassVar

from tests.machines.cluster import Cluster
from tests.machines.machine import Machine


@dataclass(frozen=True)
class MachineKilled:
    """All processes gone, connections never ended, scratch removed; an empty machine comes back."""

    joined: bool = False
    lasts: ClassVar[tuple[float, float]] = (0.0, 30.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine = cluster.joined if self.joined else drawn.choice(cluster.own)
        machine.kill()
        try:
            yield machine
        finally:
            machine.start()
