"""Databases that can hold the catalogue, one a file: how units of work begin, what errors mean.

A database is a family member with one file and one line in `DATABASES`. The specifications of the
catalogue, in `tests/storage/catalogue`, are those of each of them.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Final, Protocol

from sqlalchemy import URL, Connection, make_url
from sqlalchemy.exc import ArgumentError, DBAPIError

from jointplay.storage.catalogue.databases.postgresql import PostgreSQL
from jointplay.storage.catalogue.databases.sqlite import SQLite
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.sqlite_address import sqlite_file


class Database(Protocol):
    """One process's connections to a database."""

    apart: bool
    """Whether it may lose what is not durable while those who wrote it go on."""

    def make(self) -> None:
        """Make what the address names if it is a file, where there is none yet."""
        ...

    def reading(self) -> AbstractContextManager[Connection]:
        """Open a consistent view."""
        ...

    def writing(self, *, durable: bool) -> AbstractContextManager[Connection]:
        """Begin a writing unit, committed at the end; `durable`: it survives a power cut."""
        ...

    def mark(self, connection: Connection) -> int | None:
        """Return what tells later whether a unit was committed; None where it is always known."""
        ...

    def committed(self, mark: int) -> bool:
        """Tell whether the unit of a mark was; Interrupted while that is not known."""
        ...

    def now(self) -> float:
        """Return the time that all who share the database go by, epoch seconds."""
        ...

    def fault(self, error: DBAPIError) -> Unavailable | None:
        """Say in our words what may pass of the faults that the database tells; none: no such."""
        ...

    def close(self) -> None:
        """Close every connection."""
        ...


DATABASES: Final[dict[str, Callable[[URL, float], Database]]] = {
    "sqlite": SQLite,
    "postgresql": PostgreSQL,
}
"""By the name in an address; called with it, and with the seconds that a unit waits for others."""


def database_at(url: str, patience: float) -> Database:
    """Return the database at an address such as ``postgresql://user@host/jointplay``.

    Raises
    ------
    ValueError
        It is no address, or no database can be one of the catalogue there.
    """
    try:
        parsed = make_url(url)
    except ArgumentError as error:
        raise ValueError(f"{url!r} is no address of a database: {error}") from error
    name = parsed.get_backend_name()
    if name not in DATABASES:
        known = ", ".join(f"{one}://" for one in DATABASES)
        raise ValueError(f"the catalogue cannot be in {name!r}; addresses begin with {known}")
    if file := sqlite_file(url):
        parsed = parsed.set(database=str(file))  # SQLAlchemy 2.0 and 2.1 differ in what they decode
    return DATABASES[name](parsed, patience)
