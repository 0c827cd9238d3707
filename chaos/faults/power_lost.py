"""Everything ends at once, and what was not synced is gone."""

import contextlib
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random

from jointplay.chaos.installation import Installation


@dataclass(frozen=True)
class PowerLost:
    """SIGKILL of all; files of results are cut to what was synced of them, the broker is empty.

    The catalogue stays as it is, so it names more than the disk has: what a file holds is known
    from notes that the service's Python takes when it syncs, and SQLite is not Python. What was
    written over synced bytes, and the names of files, stay as well.
    """

    lasts: tuple[float, float] = (0.0, 0.0)

    def hindrance(self, installation: Installation) -> str | None:
        """Return none: it can be done everywhere."""
        return None

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Kill, cut, and start the service again."""
        installation.kill()
        synced = installation.synced_sizes()
        for folder in ("running", "results"):
            for path in (installation.data / folder).rglob("*"):
                if path.is_file():
                    status = path.stat()
                    os.truncate(path, min(synced.get(status.st_ino, 0), status.st_size))
        with contextlib.suppress(FileNotFoundError):
            shutil.rmtree(installation.data / "broker")
        yield
        installation.start()
