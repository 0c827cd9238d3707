"""Machines that compute for one service, and the servers that they share."""

import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from itertools import count
from pathlib import Path

from jointplay.chaos.installation import LEASE
from jointplay.chaos.processes import Process
from jointplay.storage.settings import Settings
from tests.machines.machine import Machine
from tests.machines.network import Port, make_bridge
from tests.machines.servers import Servers, running_servers
from tests.waiting import until

WORKERS = 2
"""Blocks that each of the machines computes at a time."""
_NAMES = ("first", "second")
_CONNECT = 1.0  # s
_PAUSE = 5.0  # s, in which an API that did not answer is asked nothing


class Cluster:
    """See above; an installation to users and checks."""

    def __init__(self, servers: Servers, machines: tuple[Machine, ...], folder: Path) -> None:
        self.servers, self.machines = servers, machines
        self.settings = Settings(
            data=folder,
            catalogue_url=servers.environment["JOINTPLAY_CATALOGUE_URL"],
            results_url=servers.environment["JOINTPLAY_RESULTS_URL"],
            lease=LEASE,
            heartbeat=1.0,
        )
        self._turn = count()
        self._silent_until = dict.fromkeys(machines, 0.0)

    @property
    def url(self) -> str:
        """Address of an API that is there, another one each time: what a balancer does."""
        turn = next(self._turn)
        for number in range(len(self.machines)):
            machine = self.machines[(turn + number) % len(self.machines)]
            now = time.monotonic()
            if now > self._silent_until[machine]:
                if _answers(machine):
                    return machine.url
                self._silent_until[machine] = now + _PAUSE
        return self.machines[turn % len(self.machines)].url

    def running(self) -> list[Process]:
        """Return the processes of all machines."""
        return [process for machine in self.machines for process in machine.running()]


def _answers(machine: Machine) -> bool:
    try:
        socket.create_connection((machine.port.address, 8000), _CONNECT).close()
        return True
    except OSError:
        return False


@contextmanager
def running_cluster(folder: Path) -> Iterator[Cluster]:
    """Start servers and machines; this process must have a network namespace of its own."""
    make_bridge()
    (folder / "checks").mkdir()
    with running_servers(Port("servers", 10), folder / "servers") as servers:
        machines = tuple(
            Machine(folder / name, Port(name, 11 + number), WORKERS, servers.environment)
            for number, name in enumerate(_NAMES)
        )
        try:
            for machine in machines:
                machine.start()
            for machine in machines:
                until(partial(_answers, machine))
            yield Cluster(servers, machines, folder / "checks")
        finally:
            for machine in machines:
                machine.kill()
