"""Machines that compute for one service, and the servers that they share."""

import socket
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from functools import partial
from itertools import count
from pathlib import Path

from jointplay.chaos.installation import LEASE
from jointplay.chaos.processes import Process
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.machines.balancer import Balancer
from tests.machines.joined_machine import JoinedMachine
from tests.machines.machine import API, Machine
from tests.machines.network import Port, make_bridge
from tests.machines.servers import Servers, running_servers
from tests.waiting import until

WORKERS = 2
"""Blocks that each of the machines computes at a time."""
_NAMES = ("first", "second")
_SCOPES = ("jobs:write", "jobs:read", "results:read")
_CONNECT = 1.0  # s
_PAUSE = 5.0  # s, in which an API that did not answer is asked nothing


class Cluster:
    """See above; an installation to users and checks.

    Parameters
    ----------
    own
        Machines that reach the servers; each has an API.
    joined
        The one that reaches the APIs alone.
    key
        Of the user.
    """

    def __init__(
        self,
        servers: Servers,
        own: tuple[Machine, ...],
        joined: JoinedMachine,
        settings: Settings,
        key: str,
    ) -> None:
        self.servers, self.joined, self.settings, self.key = servers, joined, settings, key
        self.own, self.machines = own, (*own, joined)
        self._turn = count()
        self._silent_until = dict.fromkeys(own, 0.0)

    @property
    def url(self) -> str:
        """Address of an API that is there, another one each time: what a balancer does."""
        turn = next(self._turn)
        for number in range(len(self.own)):
            machine = self.own[(turn + number) % len(self.own)]
            now = time.monotonic()
            if now > self._silent_until[machine]:
                if _answers(machine):
                    return machine.url
                self._silent_until[machine] = now + _PAUSE
        return self.own[turn % len(self.own)].url

    def running(self) -> list[Process]:
        """Return the processes of all machines."""
        return [process for machine in self.machines for process in machine.running()]


def _answers(machine: Machine) -> bool:
    try:
        socket.create_connection((machine.port.address, API), _CONNECT).close()
        return True
    except OSError:
        return False


@contextmanager
def running_cluster(folder: Path) -> Iterator[Cluster]:
    """Start servers and machines; this process must have a network namespace of its own."""
    make_bridge()
    with running_servers(Port("servers", 10), folder / "servers") as servers:
        settings = Settings(
            data=folder / "checks",
            catalogue_url=servers.environment["JOINTPLAY_CATALOGUE_URL"],
            results_url=servers.environment["JOINTPLAY_RESULTS_URL"],
            lease=LEASE,
            heartbeat=1.0,
        )
        settings.data.mkdir()
        with closing(Catalogue(settings.catalogue_url)) as catalogue:
            catalogue.migrate()
            key, _ = catalogue.make_key("user", _SCOPES, "", None)
            worker_key, _ = catalogue.make_key("lab", ("worker",), "", None)
        own = tuple(
            Machine(folder / name, Port(name, 11 + number), WORKERS, servers.environment)
            for number, name in enumerate(_NAMES)
        )
        authority = folder / "authority.pem"
        apis = [(machine.port.address, API) for machine in own]
        joined = JoinedMachine(
            folder / "joined",
            Port("joined", 20),
            WORKERS,
            url=Balancer(Port("balancer", 21), apis, authority).url,
            authority=authority,
            key=worker_key,
            servers=servers.port.address,
        )
        cluster = Cluster(servers, own, joined, settings, key)
        try:
            for machine in cluster.machines:
                machine.start()
            for machine in own:
                until(partial(_answers, machine))
            yield cluster
        finally:
            for machine in cluster.machines:
                machine.kill()
