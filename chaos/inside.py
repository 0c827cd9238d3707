"""Changes inside the Python of a service under faults: its clock, and notes of what it synced.

An installation puts a copy of this file into its folder as ``sitecustomize.py``, which Python
imports when it starts. The copy knows nothing of jointplay; without the variable it does nothing.
"""

import mmap
import os
import stat
import struct
import time
from pathlib import Path

FOLDER_VARIABLE = "JOINTPLAY_CHAOS"
"""Names the installation's folder; all processes of the installation have it."""
CLOCK, SYNCED = "clock", "synced"
"""Files in it: seconds that are added to the time, as a double; lines "INODE SIZE"."""


def change(folder: Path) -> None:
    """Add the seconds of the file to `time.time`, note the size of every file that is synced."""
    with (folder / CLOCK).open("rb") as file:
        ahead = mmap.mmap(file.fileno(), 8, prot=mmap.PROT_READ)
    notes = os.open(folder / SYNCED, os.O_WRONLY | os.O_APPEND)
    true_time, true_sync = time.time, os.fsync

    def shifted_time() -> float:
        seconds: float = struct.unpack_from("d", ahead)[0]
        return true_time() + seconds

    def noted_sync(descriptor: int) -> None:
        size = os.fstat(descriptor).st_size
        true_sync(descriptor)
        found = os.fstat(descriptor)
        if stat.S_ISREG(found.st_mode):
            os.write(notes, b"%d %d\n" % (found.st_ino, size))

    time.time = shifted_time
    os.fsync = noted_sync  # type: ignore[assignment]


if FOLDER_VARIABLE in os.environ:
    change(Path(os.environ[FOLDER_VARIABLE]))
