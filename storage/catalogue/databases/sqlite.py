"""SQLite: a file on a disk that all processes share.

One write-ahead log, every writing unit starts with BEGIN IMMEDIATE. A deferred BEGIN that reads
first and writes later fails at once under contention, whatever the busy timeout.
"""

import os
import random
import sqlite3
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote

from sqlalchemy import URL, Connection, Engine, create_engine, event
from sqlalchemy.exc import DBAPIError, InterfaceError, OperationalError

from jointplay.storage.catalogue.databases.file_clock import FileClock
from jointplay.storage.catalogue.errors import BUSY, SILENT, Broken, Unavailable

_NEW_DATABASE_PATIENCE = 30.0
_FIRST_PAUSE, _LONGEST_PAUSE = 0.001, 0.02  # s
_OLD = 0.1
"""Seconds after which a unit that waits for other processes' asks twice as often, after twice that
three times: SQLite's own waiting asks ever more rarely, so that the latest comer goes first."""
_CANNOT = ("SQLITE_IOERR", "SQLITE_CANTOPEN", "SQLITE_PROTOCOL", "SQLITE_READONLY")
_BROKEN = ("SQLITE_CORRUPT", "SQLITE_NOTADB", "SQLITE_ERROR")
"""The last one: a table or a column is not there."""


class SQLite:
    """See `storage.catalogue.databases.Database`. Writing units of one process take turns.

    Parameters
    ----------
    url
        Of a file, which `make` makes.
    patience
        Seconds that a unit waits for others.
    """

    apart = False

    def __init__(self, url: URL, patience: float) -> None:
        if not url.database or url.database == ":memory:":
            raise ValueError(f"the catalogue needs a file, such as sqlite:///jobs.sqlite: {url}")
        self._file = Path(url.database).absolute()
        self._index = f"{url.database}-shm"
        self._clock = FileClock(self._file.parent)
        # not made by a connection: an empty file would stand in for one that is gone
        existing = {"mode": "rw", "uri": "true"}
        url = url.set(database=f"file:{quote(url.database)}", query=existing)
        self._patience = patience
        self._readers = self._engine(url, "NORMAL", writes=False)
        self._writer = self._engine(url, "NORMAL", writes=True)
        # what a submission answers with 202 must survive a power cut; progress need not
        self._durable_writer = self._engine(url, "FULL", writes=True)
        self._turn = threading.Lock()  # without the database's lock, for which others only poll
        self._opened: os.stat_result | None = None

    def _engine(self, url: URL, synchronous: Literal["NORMAL", "FULL"], *, writes: bool) -> Engine:
        engine = create_engine(url, max_overflow=-1)  # as many as threads, of which none waits
        patience = 0.0 if writes else self._patience  # a writer waits by itself

        @event.listens_for(engine, "connect")
        def _configure(dbapi_connection: Any, _record: object) -> None:
            dbapi_connection.isolation_level = None  # no implicit BEGIN: ours comes below
            try:
                with closing(dbapi_connection.cursor()) as cursor:
                    cursor.execute(f"PRAGMA busy_timeout={patience * 1000:.0f}")
                    _write_ahead(cursor)
                    cursor.execute(f"PRAGMA synchronous={synchronous}")
                    cursor.execute("PRAGMA foreign_keys=ON")
            except sqlite3.Error:
                dbapi_connection.close()  # the pool does not know it yet
                raise
            self._opened = self._opened or self._file.stat()

        @event.listens_for(engine, "begin")
        def _begin(connection: Connection) -> None:
            if not (writes and self._begin_writing(connection.connection.driver_connection)):
                connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")

        return engine

    def _begin_writing(self, connection: Any) -> bool:
        """Wait until no other process writes, and begin; False if that takes too long."""
        began = time.monotonic()
        while (waited := time.monotonic() - began) <= self._patience:
            try:
                connection.execute("BEGIN IMMEDIATE")
                return True
            except sqlite3.DatabaseError as error:
                if not error.sqlite_errorname.startswith("SQLITE_BUSY"):
                    break
            pause = min(_FIRST_PAUSE + waited, _LONGEST_PAUSE) / (1.0 + waited / _OLD)
            time.sleep(random.uniform(0.5, 1.5) * pause)  # noqa: S311 - not all at once
        return False

    def make(self) -> None:
        """Make the file and its folder, where there are none yet."""
        self._file.parent.mkdir(parents=True, exist_ok=True)
        if not self._file.exists():
            self._file.touch()

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Open a view of the database as it is; writers go on."""
        self._require_file()
        with self._readers.begin() as connection:
            yield connection

    @contextmanager
    def writing(self, *, durable: bool) -> Iterator[Connection]:
        """Begin a unit that no other process can enter; `durable` waits for the disk."""
        self._require_file()
        engine = self._durable_writer if durable else self._writer
        if not self._turn.acquire(timeout=self._patience):
            raise Unavailable(BUSY)
        try:
            with engine.begin() as connection:
                yield connection
        finally:
            self._turn.release()

    def _require_file(self) -> None:
        """Refuse while the file is gone, or another one is in its place.

        What is written to a file that was removed or moved is lost. To open the other one while
        processes write the log of the first would mix both; whoever replaced it starts them anew.
        Refuse also while the log's index, which every unit writes in memory, can be no more: the
        system ends a process that writes there. Files are asked for and not opened: to close one
        would give up the locks that SQLite has on it.
        """
        try:
            found = self._file.stat()
        except OSError as error:
            raise Unavailable(SILENT) from error
        if self._opened is not None and not os.path.samestat(self._opened, found):
            raise Unavailable("is another file than the one that was opened")
        # that it is there is asked first: another thread may make it between both questions
        if os.access(self._index, os.F_OK) and not os.access(self._index, os.W_OK):
            raise Unavailable(SILENT)

    def mark(self, connection: Connection) -> int | None:
        """Return none: no answer to a commit can be lost."""
        return None

    def committed(self, mark: int) -> bool:
        """Say no: there are no marks."""
        return False

    def now(self) -> float:
        """Return the time of the file system, which is everybody's."""
        return self._clock.now()

    def fault(self, error: DBAPIError) -> Unavailable | None:
        """Recognise a full disk, a database that others hold, a file out of reach or broken."""
        name = getattr(error.orig, "sqlite_errorname", "")
        if name == "SQLITE_FULL":
            return Unavailable("has no room left on its disk", full=True)
        if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
            return Unavailable(BUSY)
        if name.startswith(_BROKEN):
            return Broken()
        lost = isinstance(error, (OperationalError, InterfaceError)) or error.connection_invalidated
        if name.startswith(_CANNOT) or (lost and not name):
            return Unavailable(SILENT)
        return None

    def close(self) -> None:
        """Close every connection."""
        for engine in (self._readers, self._writer, self._durable_writer):
            engine.dispose()
        self._opened = None


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
