"""PostgreSQL: a server that processes of several machines share.

Readers see one moment (REPEATABLE READ), writers what others committed before each statement
(READ COMMITTED). Units that change a job lock its row first, then its blocks'; whoever waits for
each other all the same is told to begin anew, as is everybody whose connection was lost.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import Final

from sqlalchemy import URL, Connection, create_engine
from sqlalchemy.exc import DBAPIError, InterfaceError, OperationalError
from sqlalchemy.exc import TimeoutError as PoolTimeout

from jointplay.storage.catalogue.databases.steady_clock import steady_seconds
from jointplay.storage.catalogue.errors import BUSY, SILENT, Broken, Interrupted, Unavailable

_CONNECTIONS: Final = 5
"""Connections that stay open; as many again are opened when all are in use."""
_CLOCK_PERIOD: Final = 1.0
"""Seconds after which the server's clock, which may be set, is looked at again."""
_TCP: Final = {
    "connect_timeout": 5,
    "keepalives_idle": 5,
    "keepalives_interval": 2,
    "keepalives_count": 3,
    "tcp_user_timeout": 10_000,
}
"""Without these a network that swallows packets is noticed after minutes; s, the last ms."""
_SESSION: Final = {
    "tcp_keepalives_idle": 5,
    "tcp_keepalives_interval": 2,
    "tcp_keepalives_count": 3,
    "tcp_user_timeout": 10_000,
    "idle_in_transaction_session_timeout": 15_000,
    "statement_timeout": 30_000,
}
"""The same for the server's side, which holds the locks of whoever vanished; then ms."""
_DEADLOCK, _SERIALIZATION, _TAKEN = "40P01", "40001", "23505"
_FULL, _LOCKED, _CANCELLED, _READ_ONLY, _IDLE = "53100", "55P03", "57014", "25006", "25P03"
_LOST: Final = ("08", "57P", _IDLE)
_CANNOT: Final = ("53", "57", "58", _READ_ONLY)
_BROKEN: Final = ("XX", "42P01", "42703", "42883", "42501")
"""Pages are damaged; a table, a column, a function or the right to use them is not there."""


class PostgreSQL:
    """See `storage.catalogue.databases.Database`. One small pool of connections.

    Parameters
    ----------
    url
        Of a database; what its query says of connections goes before the defaults.
    patience
        Seconds that a unit waits for others.
    """

    apart = True

    def __init__(self, url: URL, patience: float) -> None:
        if find_spec("psycopg") is None:
            raise ValueError(
                "a catalogue in PostgreSQL needs psycopg: pip install 'jointplay[cluster]'"
            )
        session = _SESSION | {"lock_timeout": round(patience * 1000)}
        options = " ".join(f"-c {name}={value}" for name, value in session.items())
        given = url.query.get("options", "")
        self._engine = create_engine(
            url.set(drivername="postgresql+psycopg"),
            pool_size=_CONNECTIONS,
            max_overflow=_CONNECTIONS,
            pool_timeout=patience,
            pool_recycle=1800,
            pool_use_lifo=True,
            connect_args={name: value for name, value in _TCP.items() if name not in url.query}
            | {"options": f"{options} {given if isinstance(given, str) else ' '.join(given)}"},
        )
        self._readers = self._engine.execution_options(
            isolation_level="REPEATABLE READ", postgresql_readonly=True
        )
        self._ahead: float | None = None  # the server's clock less this process's, s
        self._compared = 0.0

    def make(self) -> None:
        """Do nothing: administrators make databases."""

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Open a view of one moment."""
        with _from_the_pool(), self._readers.begin() as connection:
            self._compare_clocks(connection)
            yield connection

    @contextmanager
    def writing(self, *, durable: bool) -> Iterator[Connection]:
        """Begin a unit; others go on, and wait where they change the same rows."""
        with _from_the_pool(), self._engine.connect() as connection:
            with connection.begin():
                if connection.info.get("durable", True) is not durable:
                    wait = "DEFAULT" if durable else "off"
                    connection.exec_driver_sql(f"SET synchronous_commit TO {wait}")
                self._compare_clocks(connection)
                yield connection
            connection.info["durable"] = durable  # of the session, as the setting is now

    def mark(self, connection: Connection) -> int | None:
        """Return the id of the transaction, if it has written anything."""
        found = connection.exec_driver_sql("SELECT txid_current_if_assigned()").scalar_one()
        return None if found is None else int(found)

    def committed(self, mark: int) -> bool:
        """Tell how the transaction of an id ended; Interrupted while it goes on."""
        with self.reading() as connection:
            status = connection.exec_driver_sql("SELECT txid_status(%s)", (mark,)).scalar_one()
        if status == "in progress":
            raise Interrupted(BUSY)
        return bool(status == "committed")

    def now(self) -> float:
        """Return the server's time, by this process's steady clock since they were compared."""
        if self._ahead is None:
            with self.reading():
                pass
        return steady_seconds() + (self._ahead or 0.0)

    def _compare_clocks(self, connection: Connection) -> None:
        began = steady_seconds()
        if self._ahead is not None and began - self._compared < _CLOCK_PERIOD:
            return
        self._compared = began  # other threads need not
        asked = "SELECT extract(epoch FROM clock_timestamp())::float8"
        told: float = connection.exec_driver_sql(asked).scalar_one()
        uncertain = (steady_seconds() - began) / 2.0
        ahead = told - (began + uncertain)
        if self._ahead is None or abs(ahead - self._ahead) > uncertain:
            self._ahead = ahead  # else time would go to and fro with the network

    def fault(self, error: DBAPIError) -> Unavailable | None:
        """Recognise faults by SQLSTATE; those after which a unit may be repeated at once, too."""
        state: str = getattr(error.orig, "sqlstate", None) or ""
        gone = not state and isinstance(error, (OperationalError, InterfaceError))
        fault: Unavailable | None = None
        if state in (_DEADLOCK, _SERIALIZATION, _TAKEN):
            fault = Interrupted(BUSY)
        elif state == _FULL:
            fault = Unavailable("has no room left on its disk", full=True)
        elif state in (_LOCKED, _CANCELLED):
            fault = Unavailable(BUSY)
        elif gone or error.connection_invalidated or state.startswith(_LOST):
            fault = Interrupted(SILENT)
        elif state.startswith(_CANNOT):
            fault = Unavailable(SILENT)
        elif state.startswith(_BROKEN):
            fault = Broken()
        return fault

    def close(self) -> None:
        """Close every connection."""
        self._engine.dispose()


def lock_numbers(connection: Connection, *numbers: int) -> None:
    """Have this unit wait for those that named one of the same numbers, until they have ended.

    Numbers have 64 bits and a sign. Units of writing on SQLite take turns anyway.
    """
    if numbers and connection.dialect.name == "postgresql":
        # in one order, or two units could wait for each other
        given = ",".join(str(number) for number in sorted(set(numbers)))
        taken = "SELECT count(pg_advisory_xact_lock(one)) FROM unnest(%s::bigint[]) AS one"
        connection.exec_driver_sql(taken, (f"{{{given}}}",))


@contextmanager
def _from_the_pool() -> Iterator[None]:
    try:
        yield
    except PoolTimeout as error:
        raise Unavailable(BUSY) from error
