"""A machine that loses power, and its disks with it."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from tests.machines.cluster import Cluster
from tests.machines.machine import Machine


class MachineKilled:
    """All processes gone, connections never ended, scratch removed; an empty machine comes back."""

    lasts = (0.0, 30.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine = drawn.choice(cluster.machines)
        machine.kill()
        try:
            yield machine
        finally:
            machine.start()
