"""Names of processes by which others of the same machine know for certain that they ended.

A lease must run out only where that cannot be known: for a process that is stopped, of another
machine or container, or of a system without /proc.
"""

import os
import re
import socket
from functools import cache
from pathlib import Path
from typing import Final

_OWN_NAME: Final = re.compile(r"[^@:]*:([1-9]\d{0,9}):(\d+):(.+)", re.ASCII)
"""The form of what `own_name` returns. With a key before an "@" a worker that joined chose it."""


def own_name() -> str:
    """Return "HOST:PID:STARTED:SPACE" of this process, which no other has or ever had."""
    pid = os.getpid()
    return f"{socket.gethostname()}:{pid}:{_started(pid)}:{_pid_space()}"


def has_ended(name: str) -> bool:
    """Return whether the process of this name is certain to have ended."""
    found = _OWN_NAME.fullmatch(name)
    if found is None or not _pid_space() or found[3] != _pid_space():
        return False
    pid, started = int(found[1]), found[2]
    try:
        os.kill(pid, 0)
        return _started(pid) != started  # "": it waits for its parent; other: a later one
    except ProcessLookupError:
        return True
    except (PermissionError, OverflowError):  # another user's, whom /proc may not tell; no id
        return False


def _started(pid: int) -> str:
    """Return when a process started, in ticks since the boot; empty if it does not run."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return ""
    return "" if fields[0] in "ZX" else fields[19]


@cache
def _pid_space() -> str:
    """Return where and since when ids of processes mean the same; empty if that is not known."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        return f"{boot}:{Path('/proc/self/ns/pid').stat().st_ino}"
    except OSError:
        return ""
