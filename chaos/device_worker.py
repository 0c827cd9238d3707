"""A worker with a device, for which the processor stands: it fails as a card does."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from contextlib import closing, suppress
from typing import TYPE_CHECKING

from jointplay.chaos.processes import DEVICE, WITH_DEVICE, kill
from jointplay.solver.kernels.device.host_driver import FAILING
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable

if TYPE_CHECKING:
    from jointplay.chaos.installation import Installation

_STOP_PATIENCE = 30.0  # s
_WORK_PATIENCE = 120.0  # s; a trial takes some seconds of processor
_LOOK = 0.5  # s


class DeviceWorker:
    """Computes beside an installation's own workers, and is started by itself."""

    def __init__(self, installation: Installation) -> None:
        self._installation = installation
        self._failure = installation.folder / "device-fails"
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it; it waits for the catalogue."""
        found = self._installation
        name, _, value = WITH_DEVICE.partition("=")
        own = {
            "JOINTPLAY_DATA": str(found.data),
            "JOINTPLAY_REDIS_URL": found.broker_url,
            name: value,
            FAILING: str(self._failure),
        }
        with (found.folder / "device.log").open("ab") as messages:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "jointplay.worker"],
                stdin=subprocess.DEVNULL,
                stdout=messages,
                stderr=messages,
                env=found.environment() | own,
                start_new_session=True,
            )

    @property
    def alive(self) -> bool:
        """Whether it runs."""
        return self._process is not None and self._process.poll() is None

    def stop(self) -> None:
        """Have it give back what it computes, and end; what stays is killed."""
        if self._process is None:
            return
        self._process.terminate()
        try:
            self._process.wait(_STOP_PATIENCE)
        except subprocess.TimeoutExpired:
            kill(self._installation.folder, DEVICE)
            self._process.wait()

    def await_work(self) -> None:
        """Wait until it has tried its device and computes something, but not for ever."""
        waited_until = time.monotonic() + _WORK_PATIENCE
        with closing(Catalogue(self._installation.settings.catalogue_url)) as catalogue:
            while time.monotonic() < waited_until:
                with suppress(Unavailable):
                    if any(one.device and one.blocks for one in catalogue.workers_at_work()):
                        return
                time.sleep(_LOOK)

    def fail(self, how: str) -> None:
        """Have the device fail, until it does no more: "lost", or "memory"."""
        beside = self._failure.with_suffix(".new")
        beside.write_text(how)
        os.replace(beside, self._failure)

    def fail_no_more(self) -> None:
        """Let the device be well again."""
        self._failure.unlink(missing_ok=True)
