"""A machine that computes: an API, a relay and workers, which share nothing with other machines.

It has a network, process ids, a name and a boot of its own; what it writes is in one folder.
"""

import shutil
import signal
import subprocess
import sys
import uuid
from pathlib import Path

from jointplay.chaos.installation import Installation
from tests.machines.network import Port
from tests.waiting import until

_BOOT = """
hostname "$0"
mount --bind boot /proc/sys/kernel/random/boot_id
keep() { log=$1; shift; while [ ! -e stopping ]; do "$@" >> $log 2>&1; sleep 1; done; }
keep api.log "$1" -P -m jointplay.service.processes.api --host "$2" --port 8000 &
keep relay.log "$1" -P -m jointplay.worker.relay &
keep worker.log "$1" -P -m jointplay.worker --processes "$3" &
wait
"""
"""Ended processes are started again, as by Docker or systemd."""


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
        self.url = f"http://{port.address}:8000"
        self._given = environment
        self._scratch = folder / "scratch"

    def start(self) -> None:
        """Start it on empty disks; return at once."""
        for made in (self.data, self._scratch):
            made.mkdir()
        (self.folder / "boot").write_text(f"{uuid.uuid4()}\n")
        (self.folder / "stopping").unlink(missing_ok=True)
        command = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc", "--uts"]
        command += ["sh", "-ec", _BOOT, self.name]
        command += [sys.executable, self.port.address, str(self._workers)]
        with self.port.inside():
            self._service = subprocess.Popen(
                command, cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL
            )

    def environment(self) -> dict[str, str]:
        """Return the variables of its processes."""
        own = {
            "JOINTPLAY_DATA": str(self.data),
            "JOINTPLAY_KEYS": "none",
            "JOINTPLAY_HOSTS": self.port.address,
            "TMPDIR": str(self._scratch),
        }
        return super().environment() | self._given | own

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
