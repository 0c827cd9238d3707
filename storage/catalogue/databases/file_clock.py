"""The time that all who share a file system go by: its own, which stamps what is changed."""

import os
import tempfile
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Final

from jointplay.storage.catalogue.databases.steady_clock import steady_seconds

_PERIOD: Final = 1.0
"""Seconds after which clocks are compared again."""
_APART: Final = 2.0
"""Seconds by which a process's own clock may differ: some file systems know no parts of them."""


class FileClock:
    """A process's clock, set right by the stamps of files in a folder.

    Leases that processes give, keep and take from each other all run by the same clock then,
    whatever their own show. While nothing can be stamped, own time goes on evenly.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._ahead = 0.0  # the file system's clock less this process's, s
        self._shown: float | None = None  # this process's less its steady one when compared, s
        self._compared = 0.0

    def now(self) -> float:
        """Return epoch seconds."""
        own, steady = time.time(), steady_seconds()
        with self._lock:
            shown = own - steady
            set_since = self._shown is not None and abs(shown - self._shown) > _APART
            if set_since or self._shown is None or steady - self._compared >= _PERIOD:
                self._compare(own, shown)
                self._compared = steady
            return own + self._ahead

    def _compare(self, own: float, shown: float) -> None:
        before = shown if self._shown is None else self._shown
        self._ahead += before - shown
        self._shown = shown
        with suppress(OSError):
            ahead = self._stamp() - own
            self._ahead = ahead if abs(ahead) > _APART else 0.0

    def _stamp(self) -> float:
        with tempfile.TemporaryFile(dir=self._folder) as file:
            os.utime(file.fileno())
            return os.fstat(file.fileno()).st_mtime
