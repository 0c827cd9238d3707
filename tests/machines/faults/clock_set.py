"""A machine whose clock is a minute ahead or behind."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from tests.machines.cluster import Cluster
from tests.machines.machine import Machine

_OFF = 60.0  # s


class ClockSet:
    """`time.time` of every Python process there, and no other clock, jumps, and jumps back."""

    lasts = (10.0, 30.0)

    @contextmanager
    def strike(self, cluster: Cluster, drawn: Random) -> Iterator[Machine | None]:
        machine = drawn.choice(cluster.machines)
        machine.set_clock(drawn.choice((-_OFF, _OFF)))
        try:
            yield machine
        finally:
            machine.set_clock(0.0)
