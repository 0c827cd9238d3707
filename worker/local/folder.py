"""The files of a local run's folder, and who may write them."""

import errno
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from jointplay.storage import durable

JOB_FILE = "job.json"
STORE = "results.zarr.zip"
"""The sealed store, in one file."""
RUNNING = "running"
"""Folder of what goes on, or can go on: growing stores and restart points; none once it ended."""
OUTCOME_FILE = "outcome.json"
"""End of the run: its state, times, and error."""
_LOCK = "lock"


def write_job(folder: Path, job: Mapping[str, Any]) -> None:
    """Write a filled-in job into a run's folder; durable on return."""
    durable.write(folder / JOB_FILE, [(json.dumps(job, indent=2) + "\n").encode()])


@contextmanager
def holding(folder: Path) -> Iterator[Path]:
    """Keep other processes from computing into a run's folder; give its `RUNNING`, which is made.

    Raises
    ------
    BlockingIOError
        Another process holds it.
    """
    from filelock import FileLock, Timeout  # asyncio, which readers of the names need not

    running = folder / RUNNING
    running.mkdir(exist_ok=True)
    lock = FileLock(running / _LOCK)
    try:
        lock.acquire(blocking=False)
    except Timeout as error:
        sentence = "another process is computing it; wait until that has ended"
        raise BlockingIOError(errno.EWOULDBLOCK, sentence, str(folder)) from error
    try:
        yield running
    finally:
        lock.release()
