"""A whole service in a folder of its own, made to be broken."""

import json
import os
import shutil
import signal
import struct
import subprocess
import sys
from pathlib import Path
from typing import Final

from jointplay.chaos import inside
from jointplay.chaos.device_worker import DeviceWorker
from jointplay.chaos.gate import Gate
from jointplay.chaos.processes import Process, kill, running
from jointplay.chaos.servers import database_behind_gate, store_behind_gate
from jointplay.service.processes import StartFailed
from jointplay.storage.settings import Settings

LEASE: Final = 8.0
"""Seconds; eight heartbeats, of which a busy machine may swallow some."""
_SETTINGS: Final = {
    "JOINTPLAY_LEASE": f"{LEASE:g}",
    "JOINTPLAY_HEARTBEAT": "1",
    "JOINTPLAY_PROGRESS_PERIOD": "0.5",
    "JOINTPLAY_REAPER_PERIOD": "0.5",
    "JOINTPLAY_REPUBLISH_AFTER": "5",
    "JOINTPLAY_MAX_ATTEMPTS": "50",  # so many faults in a row are not the job's
    "JOINTPLAY_RESERVE": f"{2**23}",
}
_STOP_PATIENCE = 60.0  # s


class Installation:
    """Broker, API, relay and workers on a data folder of their own.

    Parameters
    ----------
    folder
        Absolute; is there, and empty but for a file system of its own, if any, at `data`.
    workers
        How many blocks are computed at a time.
    catalogue_url, results_url
        An empty database and an empty object store; by default a file and a folder of its own.
    device
        Whether there is a further worker, whose device the processor stands for.
    """

    def __init__(
        self,
        folder: Path,
        workers: int,
        catalogue_url: str = "",
        results_url: str = "",
        *,
        device: bool = False,
    ) -> None:
        self.folder = folder
        self.data = folder / "data"
        self.servers = catalogue_url, results_url
        through_database, database = database_behind_gate(catalogue_url)
        through_store, store = store_behind_gate(results_url)
        self.gates: dict[str, Gate | None] = {"database": database, "store": store}
        self._addresses = {
            "JOINTPLAY_CATALOGUE_URL": through_database,
            "JOINTPLAY_RESULTS_URL": through_store,
        }
        self.settings = Settings(
            data=self.data,
            catalogue_url=catalogue_url,
            results_url=results_url,
            redis_url=None,
            lease=LEASE,
            heartbeat=1.0,
        )
        self.broker_url = f"unix://{self.data / 'broker' / 'redis.sock'}"
        self.url = ""
        self._workers = workers
        self.device = DeviceWorker(self) if device else None
        self._service: subprocess.Popen[bytes] | None = None
        self.set_clock(0.0)
        for notes in (inside.SYNCED, inside.COMMITTED):
            (folder / notes).touch()
        (folder / "scratch").mkdir()
        modules = folder / "modules"
        modules.mkdir()
        shutil.copy(inside.__file__, modules / "sitecustomize.py")

    def start(self) -> None:
        """Start what does not run, on what an earlier one left; StartFailed without an answer."""
        if self._service is None or self._service.poll() is not None:
            self._start_service()
        if self.device is not None and not self.device.alive:
            self.device.start()

    def _start_service(self) -> None:
        log = self.folder / "supervisor.log"
        command = [sys.executable, "-P", "-m", "jointplay.service.processes"]
        command += ["--data", str(self.data), "--workers", str(self._workers)]
        with log.open("ab") as messages:
            self._service = subprocess.Popen(  # noqa: S603 - our own program
                command,
                stdin=subprocess.PIPE,  # its end tells the service of ours
                stdout=subprocess.PIPE,
                stderr=messages,
                env=self.environment(),
                start_new_session=True,  # a share of the machine's time that is not ours
            )
        answer = self._service.stdout.readline() if self._service.stdout else b""
        if not answer:
            raise StartFailed(log.read_text(errors="replace").strip())
        self.url = json.loads(answer)["url"]

    def environment(self) -> dict[str, str]:
        """Return the variables of its processes."""
        ours = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith("JOINTPLAY_") or name == "JOINTPLAY_CACHE"
        }
        ours[inside.FOLDER_VARIABLE] = str(self.folder)
        ours["PYTHONPATH"] = str(self.folder / "modules")
        ours["TMPDIR"] = str(self.folder / "scratch")  # what killed workers leave goes with it
        return ours | _SETTINGS | self._addresses

    def stop(self) -> None:
        """Stop the service as its user would; what is still there a minute later is killed."""
        if self.device is not None:
            self.device.stop()
        if self._service is None:
            return
        self._service.send_signal(signal.SIGTERM)
        try:
            self._service.wait(_STOP_PATIENCE)
        except subprocess.TimeoutExpired:
            self.kill()

    def kill(self, *roles: str) -> None:
        """Kill the processes of some roles, or all."""
        kill(self.folder, *roles)
        if self.device is not None and not roles:
            self.device.stop()  # waits
        if self._service is not None and (not roles or "supervisor" in roles):
            with self._service:  # waits, and closes its pipes
                pass

    def running(self, *roles: str) -> list[Process]:
        """Return the processes of these roles that run, or all."""
        return running(self.folder, *roles)

    @property
    def alive(self) -> bool:
        """Whether its supervisor runs, and the worker with a device if there is one."""
        served = self._service is not None and self._service.poll() is None
        return served and (self.device is None or self.device.alive)

    def set_clock(self, ahead: float) -> None:
        """Have the clock of its processes be ahead of the true time [s], at once."""
        with (self.folder / inside.CLOCK).open("r+b" if self._has_clock() else "wb") as clock:
            clock.write(struct.pack("d", ahead))

    def _has_clock(self) -> bool:
        return (self.folder / inside.CLOCK).exists()
