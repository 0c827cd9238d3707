"""Changes inside the Python of a service under faults: its clock, and notes of what it synced.

An installation puts a copy of this file into its folder as ``sitecustomize.py``, which Python
imports when it starts. The copy knows nothing of jointplay; without the variable it does nothing.
"""

import mmap
import os
import sqlite3
import stat
import struct
import time
from functools import partial
from pathlib import Path
from typing import Any

FOLDER_VARIABLE = "JOINTPLAY_CHAOS"
"""Names the installation's folder; all processes of the installation have it."""
CLOCK, SYNCED, COMMITTED = "clock", "synced", "committed"
"""Files in it: seconds that are added to the time, as a double; lines "INODE SIZE" of files that
were synced; beginnings of the catalogue's WAL index after transactions that were synced."""
INDEX = Path("data", "catalogue.sqlite-shm")
INDEX_SIZE = 48
"""Bytes of the first copy of the index's header; https://www.sqlite.org/walformat.html."""
_FULL = 2  # of PRAGMA synchronous: commits wait for the disk


def change(folder: Path) -> None:
    """Add the seconds of the file to the time; note what is synced, and when."""
    _change_the_clock(folder)
    _note_files(folder)
    _note_transactions(folder)


def _change_the_clock(folder: Path) -> None:
    with (folder / CLOCK).open("rb") as file:
        ahead = mmap.mmap(file.fileno(), 8, prot=mmap.PROT_READ)
    true_time = time.time

    def shifted_time() -> float:
        seconds: float = struct.unpack_from("d", ahead)[0]
        return true_time() + seconds

    time.time = shifted_time
    true_stamp = os.utime

    def shifted_stamp(file: Any, times: Any = None, **named: Any) -> None:
        """Stamp a file as the file system of a machine with this clock does."""
        now = shifted_time()
        true_stamp(file, (now, now) if times is None and not named else times, **named)

    os.utime = shifted_stamp  # type: ignore[assignment]


def _note_files(folder: Path) -> None:
    notes = os.open(folder / SYNCED, os.O_WRONLY | os.O_APPEND)
    true_sync = os.fsync

    def noted_sync(descriptor: int) -> None:
        size = os.fstat(descriptor).st_size
        true_sync(descriptor)
        found = os.fstat(descriptor)
        if stat.S_ISREG(found.st_mode):
            os.write(notes, b"%d %d\n" % (found.st_ino, size))

    os.fsync = noted_sync  # type: ignore[assignment]


def _note_transactions(folder: Path) -> None:
    notes = os.open(folder / COMMITTED, os.O_WRONLY | os.O_APPEND)
    indices: list[int] = []  # the last is the present one

    def opened() -> int:
        """Open the index, and never close it: that would end SQLite's locks on it."""
        path = folder / INDEX
        if not indices or not os.path.samestat(path.stat(), os.fstat(indices[-1])):
            indices.append(os.open(path, os.O_RDONLY))
        return indices[-1]

    class Connection(sqlite3.Connection):
        def commit(self) -> None:
            super().commit()
            if self.execute("PRAGMA synchronous").fetchone() == (_FULL,):
                first = second = b""
                while not first or first != second:  # it is just being written
                    copies = os.pread(opened(), 2 * INDEX_SIZE, 0)
                    first, second = copies[:INDEX_SIZE], copies[INDEX_SIZE:]
                os.write(notes, first)

    sqlite3.dbapi2.connect = partial(sqlite3.connect, factory=Connection)  # type: ignore[assignment]


if FOLDER_VARIABLE in os.environ:
    change(Path(os.environ[FOLDER_VARIABLE]))
