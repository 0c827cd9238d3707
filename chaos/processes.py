"""The processes of one installation, known by a variable that all of them have inherited.

The broker writes its title over its command and variables; it is known by its working directory.
"""

import contextlib
import os
import signal
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from jointplay.chaos.inside import FOLDER_VARIABLE

DEVICE: Final = "device"
ROLES: Final = ("computing", "worker", DEVICE, "api", "relay", "broker", "supervisor")
"""Roles of processes that faults choose from; "computing" are the children of the worker, "device"
are the worker that has one, and its child.

Beside them there are those that compile or check documents, which end with those who wait for them.
"""
WITH_DEVICE: Final = "JOINTPLAY_DEVICE=host"
"""Variable of the worker that has a device."""
_MODULES: Final = {
    "jointplay.service.processes.api": "api",
    "jointplay.worker.relay": "relay",
    "jointplay.worker": "worker",
    "jointplay": "worker",  # `jointplay worker --join`
    "jointplay.service.processes": "supervisor",
    "jointplay.solver.kernels.compile_file": "compiling",
    "jointplay.service.checking": "checking",
}
_PATIENCE = 30.0  # s, until a killed process is gone


@dataclass(frozen=True)
class Process:
    """A process that was found running."""

    pid: int
    role: str

    def send(self, number: signal.Signals) -> bool:
        """Send a signal; tell whether the process was still there."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, number)
            return True
        return False


def running(folder: Path, *roles: str) -> list[Process]:
    """Return the processes of the installation in a folder, of these roles or of all."""
    mark = f"{FOLDER_VARIABLE}={folder}".encode()
    found: dict[int, tuple[int, str | None]] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it ended meanwhile, or it is another user's
            parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            if (entry / "cwd").readlink() == folder / "data" / "broker":
                found[int(entry.name)] = parent, "broker"
            elif mark in (variables := (entry / "environ").read_bytes().split(b"\0")):
                role = _role((entry / "cmdline").read_bytes().decode().split("\0"))
                if role == "worker" and WITH_DEVICE.encode() in variables:
                    role = DEVICE
                found[int(entry.name)] = parent, role
    found.pop(os.getpid(), None)
    workers = {pid for pid, (_, role) in found.items() if role == "worker"}
    processes = []
    for pid, (parent, known) in found.items():
        # a child of the worker has its command line, also when the worker is gone
        is_child = known == "worker" and (parent in workers or parent == 1)
        role = "computing" if is_child else known
        if role is not None and (not roles or role in roles):
            processes.append(Process(pid, role))
    return sorted(processes, key=lambda process: process.pid)


def _role(command: list[str]) -> str | None:
    for module, role in _MODULES.items():
        if module in command:
            return role
    return None


def kill(folder: Path, *roles: str) -> None:
    """Kill the processes of these roles, or all, until none is left."""
    end(running(folder, *roles))
    if not roles:
        while left := running(folder):  # what was about to be started
            end(left)


def end(processes: Iterable[Process]) -> None:
    """Kill processes, and wait until they are gone."""
    gone_by = time.monotonic() + _PATIENCE
    killed = [process for process in processes if process.send(signal.SIGKILL)]
    while any(_runs(process.pid) for process in killed):
        if time.monotonic() > gone_by:
            raise TimeoutError(f"still there after SIGKILL: {killed}")
        time.sleep(0.02)


def _runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False
