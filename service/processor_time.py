"""Processor time of a process that this one has started, where the system tells it."""

import os
from contextlib import suppress
from pathlib import Path


def processor_time(pid: int) -> float | None:
    """Return the seconds that a process and what it has started have computed; None if not known.

    Linux tells it, by ticks of 10 ms.
    """
    ticks = _ticks(pid)
    return None if ticks is None else ticks / os.sysconf("SC_CLK_TCK")


def _ticks(pid: int) -> int | None:
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        threads = [*Path(f"/proc/{pid}/task").iterdir()]
    except OSError:
        return None
    children: list[str] = []
    for one in threads:
        with suppress(OSError):  # it has ended meanwhile
            children += (one / "children").read_text().split()
    ended_too = sum(map(int, fields[11:15]))  # of children that have ended and were waited for
    return ended_too + sum(_ticks(int(child)) or 0 for child in children)
