"""The catalogue held by another program, such as one that makes a backup."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_PATIENCE = 30.0  # s, until the service lets it have the lock


class CatalogueLocked(Fault):
    """A transaction that nobody else can write beside."""

    lasts = (10.0, 75.0)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Take the lock, and give it back."""
        file = installation.data / "catalogue.sqlite"
        with closing(sqlite3.connect(file, timeout=_PATIENCE, isolation_level=None)) as database:
            database.execute("BEGIN EXCLUSIVE")
            yield
            database.execute("ROLLBACK")
