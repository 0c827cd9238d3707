"""Machines that compute for one service, and the servers that they share."""

import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from itertools import count
from pathlib import Path
from urllib.parse import urlsplit

from trustme import CA

from jointplay.chaos.installation import LEASE
from jointplay.chaos.processes import Process
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.machines.balancer import Balancer
from tests.machines.door import Door
from tests.machines.joined_machine import JoinedMachine
from tests.machines.machine import API, Machine
from tests.machines.network import Port, make_bridge
from tests.machines.passing import certified
from tests.machines.servers import Servers, running_servers
from tests.waiting import until

WORKERS = 2
"""Blocks that each of the machines computes at a time."""
_NAMES = ("first", "second")
_SCOPES = ("jobs:write", "jobs:read", "results:read")
_PAUSE = 5.0  # s, in which an API that did not answer is asked nothing


class Cluster:
    """See above; an installation to users and checks.

    Parameters
    ----------
    own
        Machines that reach the servers; each has an API.
    joined
        The one that reaches the APIs and the door alone.
    door
        To the bucket.
    key
        Of the user.
    """

    def __init__(
        self,
        servers: Servers,
        own: tuple[Machine, ...],
        joined: JoinedMachine,
        door: Door,
        settings: Settings,
        key: str,
    ) -> None:
        self.servers, self.joined, self.settings, self.key = servers, joined, settings, key
        self.door = door
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
                if machine.answers():
                    return machine.url
                self._silent_until[machine] = now + _PAUSE
        return self.own[turn % len(self.own)].url

    def running(self) -> list[Process]:
        """Return the processes of all machines."""
        return [process for machine in self.machines for process in machine.running()]


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
        authority, file = CA(), folder / "authority.pem"
        authority.cert_pem.write_to_path(file)
        outside, balanced, gate = Port("door", 22), Port("balancer", 21), urlsplit(servers.gate.url)
        door = Door(outside, (gate.hostname, gate.port), certified(authority, outside))
        environment = servers.environment | {"JOINTPLAY_RESULTS_REDIRECT": door.url}
        own = tuple(
            Machine(folder / name, Port(name, 11 + number), WORKERS, environment)
            for number, name in enumerate(_NAMES)
        )
        apis = [(machine.port.address, API) for machine in own]
        joined = JoinedMachine(
            folder / "joined",
            Port("joined", 20),
            WORKERS,
            url=Balancer(balanced, apis, certified(authority, balanced)).url,
            authority=file,
            key=worker_key,
            servers=servers.port.address,
        )
        cluster = Cluster(servers, own, joined, door, settings, key)
        try:
            for machine in cluster.machines:
                machine.start()
            for machine in own:
                until(machine.answers)
            yield cluster
        finally:
            for machine in cluster.machines:
                machine.kill()
