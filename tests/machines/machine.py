"""A machine that computes: an API, a relay and workers, which share nothing with other machines.

It has a network, process ids, a name and a boot of its own; what it writes is in one folder.
"""

import shlex
import shutil
import signal
import socket
import subprocess
import sys
import uuid
from pathlib import Path

from jointplay.chaos.installation import Installation
from tests.machines.clock import Clock
from tests.machines.network import Port
from tests.waiting import until

_BOOT = """
hostname "$0"
mount --bind boot /proc/sys/kernel/random/boot_id
keep() { log=$1; shift; while [ ! -e stopping ]; do "$@" >> $log 2>&1 || true; sleep 1; done; }
"""
"""Ended processes are started again, as by Docker or systemd."""
_CONNECT = 1.0  # s
API = 8000
"""Port number of its API."""


class Machine(Installation):
    """See above; the servers are elsewhere.

    Parameters
    ----------
    folder
        Its name is the machine's; it is made.
    """

    def __init__(self, folder: Path, port: Port, workers: int, environment: dict[str, str]) -> None:
        folder.mkdir()
        super().__init__(folder, workers)
        self.name, self.port = folder.name, port
        self.url = f"http://{port.address}:{API}"
        self._given = environment
        self.clock = Clock(folder)
        self.boot = ""
        self._scratch = folder / "scratch"

    def start(self) -> None:
        """Start it on empty disks; return at once."""
        for made in (self.data, self._scratch):
            made.mkdir(exist_ok=True)
        self.boot = str(uuid.uuid4())
        (self.folder / "boot").write_text(f"{self.boot}\n")
        (self.folder / "stopping").unlink(missing_ok=True)
        command = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc", "--uts"]
        kept = [
            f"keep {log}.log {shlex.join([sys.executable, '-P', '-m', *words])} &\n"
            for log, words in self.kept().items()
        ]
        command += ["sh", "-ec", f"{_BOOT}{''.join(kept)}wait", self.name]
        with self.port.inside():
            self._service = subprocess.Popen(
                command, cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL
            )

    def answers(self) -> bool:
        """Whether its API can be reached."""
        try:
            socket.create_connection((self.port.address, API), _CONNECT).close()
            return True
        except OSError:
            return False

    def kept(self) -> dict[str, list[str]]:
        """Return modules with arguments that run all the time, by the name of their log."""
        address = ["--host", self.port.address, "--port", str(API)]
        return {
            "api": ["jointplay.service.processes.api", *address],
            "relay": ["jointplay.worker.relay"],
            "worker": ["jointplay.worker", "--processes", str(self._workers)],
        }

    def environment(self) -> dict[str, str]:
        """Return the variables of its processes."""
        own = {
            "JOINTPLAY_DATA": str(self.data),
            "JOINTPLAY_KEYS": "required",
            "JOINTPLAY_LOG_FORMAT": "json",  # with a line for every request
            "TMPDIR": str(self._scratch),
        }
        return super().environment() | self._given | self.clock.environment | own

    def stop(self) -> None:
        """End its processes as an administrator does."""
        (self.folder / "stopping").touch()
        for process in self.running("api", "relay", "worker"):
            process.send(signal.SIGTERM)
        until(lambda: not self.alive)

    def kill(self, *_: str) -> None:
        """Have it lose power: nobody is told, its disks are gone."""
        self.port.leave()
        if self._service is not None:
            self._service.kill()  # with which its first process ends, and so all others
            self._service.wait()
        until(lambda: not self.running())
        self.port.join()
        for lost in (self.data, self._scratch):
            shutil.rmtree(lost, ignore_errors=True)
