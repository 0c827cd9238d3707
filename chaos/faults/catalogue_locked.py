"""The catalogue held by another program, such as one that makes a backup."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from sqlalchemy import create_engine, make_url

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_PATIENCE = 30.0  # s, until the service lets it have the lock


class CatalogueLocked(Fault):
    """A transaction that nobody else can write beside; in PostgreSQL nobody reads jobs either."""

    lasts = (10.0, 75.0)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Take the lock, and give it back."""
        url = make_url(installation.settings.catalogue_url)
        if url.get_backend_name() == "postgresql":
            engine = create_engine(url.set(drivername="postgresql+psycopg"))
            take = "BEGIN; LOCK TABLE job IN ACCESS EXCLUSIVE MODE"
        else:
            engine = create_engine(url, connect_args={"timeout": _PATIENCE})
            take = "BEGIN EXCLUSIVE"
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            connection.exec_driver_sql(take)
            yield
            connection.exec_driver_sql("ROLLBACK")
        engine.dispose()
