"""Clocks of programs that are set while they run: what libc tells them, C, Python and Rust alike.

Programs of Go ask the system past libc. Intervals, and what waits for them, are as they were.
"""

import struct
import subprocess
from pathlib import Path
from shutil import which

_SOURCE = Path(__file__).with_name("clock.c")
COMPILER = which("cc")


class Clock:
    """The clock of programs that are started with its environment.

    Parameters
    ----------
    folder
        Is there; others than this user may look into it.
    """

    def __init__(self, folder: Path) -> None:
        assert COMPILER is not None, "clocks are set by a library in C: install a compiler, cc"
        library, self._file = folder / "clock.so", folder / "clock"
        build = [COMPILER, "-shared", "-fPIC", "-O2", "-o", str(library), str(_SOURCE)]
        subprocess.run([*build, "-ldl", "-lm"], check=True)
        self._file.write_bytes(bytes(8))
        self.environment = {"LD_PRELOAD": str(library), "JOINTPLAY_CLOCK": str(self._file)}

    def set(self, ahead: float) -> None:
        """Have it be ahead of the true time [s], at once."""
        with self._file.open("r+b") as file:
            file.write(struct.pack("d", ahead))
