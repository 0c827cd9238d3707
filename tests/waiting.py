"""Waiting in tests for other processes: as long as something moves, however slow the machine."""

import os
import time
from collections.abc import Callable
from pathlib import Path

PATIENCE = 90.0
"""Seconds without any progress after which it is given up: starting Python takes a second, and on
a machine with ten times as much to do as it can some ten."""
_TICKS = os.sysconf("SC_CLK_TCK")


def descendants(pid: int) -> dict[int, str]:
    """Return process ids and command lines of everything that a process has started."""
    parents: dict[int, int] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        fields = _fields(int(entry.name))
        if fields and fields[0] != "Z":
            parents[int(entry.name)] = int(fields[1])
    found, new = set[int](), {pid}
    while new:
        new = {child for child, parent in parents.items() if parent in new}
        found |= new
    commands = {}
    for child in found:
        try:
            commands[child] = Path(f"/proc/{child}/cmdline").read_text().replace("\0", " ")
        except OSError:
            continue  # it has ended meanwhile
    return commands


def processor_time() -> float:
    """Return the processor time, s, of all processes that this one has started and that live."""
    stats = [_fields(pid) for pid in descendants(os.getpid())]
    return sum(int(fields[11]) + int(fields[12]) for fields in stats if fields) / _TICKS


def is_alive(pid: int) -> bool:
    """Return whether a process runs; one that only waits for its parent to notice does not."""
    fields = _fields(pid)
    return bool(fields) and fields[0] != "Z"


def until(
    condition: Callable[[], bool],
    *,
    progress: Callable[[], object] = processor_time,
    act: Callable[[], object] = lambda: time.sleep(0.05),  # leaves the processor to the others
) -> None:
    """Wait until a condition holds, and fail once nothing has moved for `PATIENCE` seconds.

    Parameters
    ----------
    progress
        Returns a value that changes while what is waited for goes on.
    act
        Done between two looks at the condition.
    """
    looked_at = moved = time.monotonic()
    reached: object = None
    while not condition():
        now = time.monotonic()
        if now - looked_at > 1.0:
            before, reached, looked_at = reached, progress(), now
            moved = moved if reached == before else now
        assert now - moved < PATIENCE, f"nothing has moved since {reached}"
        act()


def _fields(pid: int) -> list[str]:
    """Return the fields of a process's status after its name; none of a process that is gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return []
