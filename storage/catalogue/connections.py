"""Connections to the catalogue's database, and how a unit of reading or writing begins.

SQLite: one write-ahead log, every writing unit starts with BEGIN IMMEDIATE. A deferred BEGIN
that reads first and writes later fails at once under contention, whatever the busy timeout.
"""

import sqlite3
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote

from sqlalchemy import (
    URL,
    Connection,
    Engine,
    create_engine,
    event,
    make_url,
    text,
)
from sqlalchemy.exc import DBAPIError, InterfaceError, OperationalError

from jointplay.storage.catalogue.errors import Unavailable

_PATIENCE = 5.0
"""Seconds that a unit waits for others; then those who asked decide whether to ask again."""
_NEW_DATABASE_PATIENCE = 30.0
_BUSY = "is held by another program"
_SQLITE_CANNOT = ("SQLITE_IOERR", "SQLITE_CANTOPEN", "SQLITE_PROTOCOL", "SQLITE_READONLY")


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


class Connections:
    """The engines of one process. Writing units of one process take turns, without the lock.

    Parameters
    ----------
    url
        SQLAlchemy URL. For SQLite a file, which `make_file` makes.
    """

    def __init__(self, url: str) -> None:
        parsed = make_url(url)
        self._file: Path | None = None
        if parsed.get_backend_name() == "sqlite":
            if not parsed.database or parsed.database == ":memory:":
                raise ValueError(
                    f"the catalogue needs a file, such as sqlite:///jobs.sqlite: {url}"
                )
            self._file = Path(parsed.database)
            # not made by a connection: an empty file would stand in for one that is gone
            existing = {"mode": "rw", "uri": "true"}
            parsed = parsed.set(database=f"file:{quote(parsed.database)}", query=existing)
        self._readers = self._engine(parsed, "NORMAL", "BEGIN")
        self._writer = self._engine(parsed, "NORMAL", "BEGIN IMMEDIATE")
        # what a submission answers with 202 must survive a power cut; progress need not
        self._durable_writer = self._engine(parsed, "FULL", "BEGIN IMMEDIATE")
        self._turn = threading.Lock()

    def _engine(
        self, url: URL, synchronous: Literal["NORMAL", "FULL"], begin_statement: str
    ) -> Engine:
        if self._file is None:
            return create_engine(url, pool_pre_ping=True)
        engine = create_engine(url)

        @event.listens_for(engine, "connect")
        def _configure(dbapi_connection: Any, _record: object) -> None:
            dbapi_connection.isolation_level = None  # no implicit BEGIN: ours comes below
            cursor = dbapi_connection.cursor()
            cursor.execute(f"PRAGMA busy_timeout={_PATIENCE * 1000:.0f}")
            _write_ahead(cursor)
            cursor.execute(f"PRAGMA synchronous={synchronous}")
            cursor.execute("PRAGMA foreign_keys=ON")
            cursor.close()

        @event.listens_for(engine, "begin")
        def _begin(connection: Connection) -> None:
            connection.exec_driver_sql(begin_statement)

        return engine

    def make_file(self) -> None:
        """Make SQLite's file and its folder, where there are none yet."""
        if self._file is not None:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            self._file.touch()

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Open a consistent view of the database; Unavailable if it does not answer."""
        with _available(), self._readers.begin() as connection:
            yield connection

    @contextmanager
    def writing(self, *, durable: bool = False) -> Iterator[Connection]:
        """Begin a writing unit, committed at the end; `durable`: it survives a power cut.

        Raises
        ------
        Unavailable
            Others write for too long, the disk is full, or the database does not answer.
        """
        engine = self._durable_writer if durable else self._writer
        if not self._turn.acquire(timeout=_PATIENCE):
            raise Unavailable(_BUSY)
        try:
            with _available(), engine.begin() as connection:
                yield connection
        finally:
            self._turn.release()

    @contextmanager
    def migrating(self) -> Iterator[Connection]:
        """Begin a writing unit that no other process can enter while it lasts."""
        with self.writing(durable=True) as connection:
            if self._file is None:
                connection.execute(text("SELECT pg_advisory_xact_lock(7411)"))
            yield connection

    def close(self) -> None:
        """Close every connection of this process."""
        for engine in (self._readers, self._writer, self._durable_writer):
            engine.dispose()


@contextmanager
def _available() -> Iterator[None]:
    """Say in our words what the database says of faults that may pass."""
    try:
        yield
    except DBAPIError as error:
        fault = _passing(error)
        if fault is None:
            raise
        raise fault from error


def _passing(error: DBAPIError) -> Unavailable | None:
    name = getattr(error.orig, "sqlite_errorname", "")
    if name == "SQLITE_FULL":
        return Unavailable("has no room left on its disk", full=True)
    if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
        return Unavailable(_BUSY)
    lost = isinstance(error, (OperationalError, InterfaceError)) or error.connection_invalidated
    if name.startswith(_SQLITE_CANNOT) or (lost and not name):
        return Unavailable("does not answer")
    return None


def _write_ahead(cursor: sqlite3.Cursor) -> None:
    """Have the database keep a write-ahead log.

    A database that is new to it is locked for a moment, for which SQLite does not wait by itself.
    """
    give_up = time.monotonic() + _NEW_DATABASE_PATIENCE
    while True:
        try:
            cursor.execute("PRAGMA journal_mode=WAL")
            return
        except sqlite3.OperationalError:
            if time.monotonic() > give_up:
                raise
            time.sleep(0.01)
