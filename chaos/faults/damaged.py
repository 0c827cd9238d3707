"""Files of running jobs that lose bytes, as on a disk that wears out."""

import contextlib
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation
from jointplay.chaos.processes import DEVICE
from jointplay.storage.object_stores import StoredObject

_SHARE = 0.5  # of the files


class Damaged(Fault):
    """Bytes flipped, cut off, or whole files missing, of restart points, journals and the like.

    Those who wrote them are killed first: what they would still write over them would hide it.
    Sealed results are no part of it: of these there is no second copy to go on from.
    """

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Kill the computing processes and damage half of what they have written."""
        installation.kill("computing", DEVICE)
        if installation.settings.sends:
            store = installation.settings.object_store
            for key in sorted(store.list("running/")):
                if drawn.random() < _SHARE:
                    _harm_object(StoredObject(store, key), drawn)
        for path in sorted((installation.data / "running").rglob("*")):
            if path.is_file() and drawn.random() < _SHARE:
                drawn.choice((_flip, _cut, _remove))(path, drawn)
        if not installation.alive:  # the worker with a device is started by nobody else
            installation.start()
        yield


def _harm_object(stored: StoredObject, drawn: Random) -> None:
    """Do to an object what is done to files; one that is gone by now is left alone."""
    with contextlib.suppress(FileNotFoundError), tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "object")
        path.write_bytes(stored.read(0, stored.size()))
        drawn.choice((_flip, _cut, _remove))(path, drawn)
        if path.exists():
            stored.object_store.replace(stored.key, [path.read_bytes()])
        else:
            stored.object_store.remove(stored.key)


def _flip(path: Path, drawn: Random) -> None:
    with path.open("r+b") as file:
        offset = drawn.randrange(max(os.fstat(file.fileno()).st_size, 1))
        file.seek(offset)
        byte = file.read(1)
        file.seek(offset)
        file.write(bytes(value ^ 1 << drawn.randrange(8) for value in byte))


def _cut(path: Path, drawn: Random) -> None:
    os.truncate(path, drawn.randrange(path.stat().st_size + 1))


def _remove(path: Path, drawn: Random) -> None:
    path.unlink()
