"""The machine of the servers: PostgreSQL, Redis, and an S3-compatible store behind a gate."""

import os
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from urllib.parse import urlsplit

from jointplay.service.processes.broker import answers, server_binary
from tests.machines.clock import Clock
from tests.machines.gate import Gate
from tests.machines.network import Port
from tests.postgresql_server import Server, running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.waiting import until


class Redis:
    """A Redis that stores nothing."""

    def __init__(self, port: Port, folder: Path, clock: Clock) -> None:
        self.clock = clock
        self.url = f"redis://{port.address}:6379/0"
        self._port, self._folder = port, folder
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        command = [str(server_binary()), "--bind", self._port.address, "--protected-mode", "no"]
        command += ["--save", "", "--appendonly", "no", "--dir", str(self._folder)]
        with (self._folder / "redis.log").open("ab") as log, self._port.inside():
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=log,
                env=os.environ | self.clock.environment,
            )
            until(lambda: answers(self.url))

    def kill(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()


class Servers:
    """The running servers, and where they are; the clock is the database's."""

    def __init__(
        self, port: Port, database: Server, clock: Clock, redis: Redis, gate: Gate
    ) -> None:
        self.port, self.database, self.redis, self.gate = port, database, redis, gate
        self.clock = clock
        self.environment = {
            "JOINTPLAY_CATALOGUE_URL": database.new("template0"),
            "JOINTPLAY_RESULTS_URL": f"s3://{BUCKET}/cluster?endpoint={gate.url}",
            "JOINTPLAY_REDIS_URL": redis.url,
        }


@contextmanager
def running_servers(port: Port, folder: Path) -> Iterator[Servers]:
    """Start the servers on the machine at a port."""
    folder.mkdir()
    for name in ("database", "redis"):
        (folder / name).mkdir()
    clock, redis = Clock(folder / "database"), Redis(port, folder, Clock(folder / "redis"))
    with ExitStack() as stack:
        with port.inside():
            database = stack.enter_context(
                running_server(fsync=True, host=port.address, environment=clock.environment)
            )
            store = stack.enter_context(running_store(port.address))
        redis.start()
        stack.callback(redis.kill)
        number = urlsplit(store).port
        assert number is not None
        yield Servers(port, database, clock, redis, Gate(port, number))
