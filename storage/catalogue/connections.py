"""Connections to the catalogue's database, and what a unit of reading or writing is."""

import secrets
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError, IntegrityError

from jointplay.storage.catalogue.databases import database_at
from jointplay.storage.catalogue.databases.postgresql import lock_numbers
from jointplay.storage.catalogue.errors import Interrupted

_PATIENCE = 5.0
"""Seconds that a unit waits for others; then those who asked decide whether to ask again."""
_FIRST_PAUSE, _LONGEST_PAUSE = 0.01, 0.5
"""Seconds before a unit that was interrupted begins anew."""
_MIGRATION = 7411  # an own number, under which processes take turns
Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Unit:
    """One unit of reading or writing: all of it at one moment, committed together."""

    connection: Connection
    now: float
    """Epoch seconds."""

    @property
    def execute(self) -> Any:
        """Execute a statement, or an insertion with many rows; see `Connection.execute`."""
        return self.connection.execute

    @property
    def shared(self) -> bool:
        """Whether others change rows meanwhile, and the database has `functions` of ours."""
        return self.connection.dialect.name == "postgresql"


class Connections:
    """The connections of one process.

    Parameters
    ----------
    url
        SQLAlchemy URL of a database of `storage.catalogue.databases`.
    """

    def __init__(self, url: str) -> None:
        self._database = database_at(url, _PATIENCE)

    def make_database(self) -> None:
        """Make a database that is a file, where there is none yet; its tables are not made."""
        self._database.make()

    def now(self) -> float:
        """Return the present time, epoch seconds; Unavailable if only the database knows it."""
        with self._available():
            return self._database.now()

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Open a consistent view of the database; Unavailable if it does not answer."""
        with self._available(), self._database.reading() as connection:
            yield connection

    @contextmanager
    def writing(self, *, durable: bool = False) -> Iterator[Connection]:
        """Begin a writing unit, committed at the end; `durable`: it survives a power cut.

        Raises
        ------
        Unavailable
            Others write for too long, the disk is full, or the database does not answer.
        Interrupted
            It may be begun anew at once; see `repeated`.
        """
        with self._available(), self._database.writing(durable=durable) as connection:
            yield connection

    @contextmanager
    def claiming(self) -> Iterator[Connection]:
        """Begin a writing unit that lasts as long as the process that asks for it.

        A database that goes down alone, and forgets that a block is held, would give a second
        worker the number of the first one's attempt.
        """
        with self.writing(durable=self._database.apart) as connection:
            yield connection

    @contextmanager
    def migrating(self) -> Iterator[Connection]:
        """Begin a writing unit that no other process can enter while it lasts."""
        with self.writing(durable=True) as connection:
            if self._database.apart:
                connection.exec_driver_sql("SET LOCAL lock_timeout = 0")
                connection.exec_driver_sql("SET LOCAL statement_timeout = 0")
            lock_numbers(connection, _MIGRATION)
            yield connection

    def repeated(self, unit: Callable[[], Answer]) -> Answer:
        """Carry out a unit, anew where it was interrupted, for as long as units wait for others.

        If only the answer to a commit was lost, a unit that is repeated must find that it was done;
        of one that cannot, see `mark`.
        """
        give_up = time.monotonic() + _PATIENCE
        pause = _FIRST_PAUSE
        while True:
            try:
                return unit()
            except Interrupted as error:
                if time.monotonic() + pause > give_up:
                    if isinstance(error.__cause__, IntegrityError):
                        raise error.__cause__ from None  # nobody else's doing
                    raise
            # apart from whoever was interrupted together with it
            time.sleep(pause * (1 + secrets.randbelow(1000) / 1000))
            pause = min(2 * pause, _LONGEST_PAUSE)

    def mark(self, connection: Connection) -> int | None:
        """Return what tells a unit that is repeated whether it was done; None: it was not."""
        return self._database.mark(connection)

    def committed(self, mark: int) -> bool:
        """Tell whether the unit of a mark was done; errors of `writing`."""
        with self._available():
            return self._database.committed(mark)

    def close(self) -> None:
        """Close every connection of this process."""
        self._database.close()

    @contextmanager
    def _available(self) -> Iterator[None]:
        """Say in our words what the database says of faults that may pass."""
        try:
            yield
        except DBAPIError as error:
            fault = self._database.fault(error)
            if fault is None:
                raise
            if why := reason(error):
                fault.add_note(why)  # for logs: clients are not told where the database is
            raise fault from error


def reason(error: DBAPIError) -> str:
    """Return what the database or its driver says of a fault, on one line; or nothing."""
    said = str(error.orig or "").strip().splitlines()
    # libpq asks behind the reason, on a line that is indented, whether the server is running
    return next((line for line in reversed(said) if not line[:1].isspace()), "")
