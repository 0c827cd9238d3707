"""Files of running jobs that lose bytes, as on a disk that wears out."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_SHARE = 0.5  # of the files


class Damaged(Fault):
    """Bytes flipped, cut off, or whole files missing, of restart points, journals and the like.

    Those who wrote them are killed first: what they would still write over them would hide it.
    Sealed results are no part of it: of these there is no second copy to go on from.
    """

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Kill the computing processes and damage half of what they have written."""
        installation.kill("computing")
        for path in sorted((installation.data / "running").rglob("*")):
            if path.is_file() and drawn.random() < _SHARE:
                drawn.choice((_flip, _cut, _remove))(path, drawn)
        yield


def _flip(path: Path, drawn: Random) -> None:
    with path.open("r+b") as file:
        place = drawn.randrange(max(os.fstat(file.fileno()).st_size, 1))
        file.seek(place)
        byte = file.read(1)
        file.seek(place)
        file.write(bytes(value ^ 1 << drawn.randrange(8) for value in byte))


def _cut(path: Path, drawn: Random) -> None:
    os.truncate(path, drawn.randrange(path.stat().st_size + 1))


def _remove(path: Path, drawn: Random) -> None:
    path.unlink()
