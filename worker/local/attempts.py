"""Attempts at a simulation: stores ``1``, ``2``, ... in a folder, each beside its restart point.

An attempt goes on from the restart point of one before, whose store it only reads.
"""

from pathlib import Path
from typing import NamedTuple

from jointplay.records.checkpoint import UnusableCheckpoint
from jointplay.worker.checkpoints import RestartPoint
from jointplay.worker.execute import restart_name


class NextAttempt(NamedTuple):
    """An attempt to come: folder of its store, and name of the restart point it goes on from."""

    folder: Path
    resume_from: str | None


class NewestAttempt(NamedTuple):
    """The store that has most, and how many of its samples are on the disk; None: whole shards."""

    folder: Path
    samples: int | None


def next_attempt(running: Path) -> NextAttempt:
    """Return the attempt that follows those in a folder; nothing is made."""
    numbers = _numbers(running)
    restart = _last_restart(running, numbers)
    return NextAttempt(running / str(max(numbers, default=0) + 1), restart)


def newest_attempt(running: Path) -> NewestAttempt | None:
    """Return the attempt of the last restart point, else the last one; None if there is none."""
    numbers = _numbers(running)
    if (name := _last_restart(running, numbers)) is not None:
        try:
            found = RestartPoint.load(running / name)
            return NewestAttempt(found.folder, found.watermark)
        except UnusableCheckpoint:  # of another version: what is in shards can be read
            pass
    return NewestAttempt(running / str(max(numbers)), None) if numbers else None


def _numbers(running: Path) -> list[int]:
    """Return the numbers of the attempts whose stores are there."""
    if not running.is_dir():
        return []
    return sorted(int(path.name) for path in running.iterdir() if path.name.isdecimal())


def _last_restart(running: Path, numbers: list[int]) -> str | None:
    for number in reversed(numbers):
        name = restart_name(str(number))
        if (running / name).exists():
            return name
    return None
