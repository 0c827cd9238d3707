"""Connections that the database ends, in whatever they were."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from sqlalchemy import create_engine, make_url

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_EVERY_OTHER = """SELECT pg_terminate_backend(pid) FROM pg_stat_activity
  WHERE datname = current_database() AND pid <> pg_backend_pid()"""


class BackendsTerminated(Fault):
    """Every connection to the catalogue ended at once, as an administrator can."""

    def hindrance(self, installation: Installation) -> str | None:
        """Return why, unless the catalogue is in PostgreSQL."""
        if installation.settings.catalogue_url.startswith("postgresql"):
            return None
        return "the catalogue is a file"

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """End them."""
        url = make_url(installation.settings.catalogue_url)
        engine = create_engine(url.set(drivername="postgresql+psycopg"))
        with engine.connect() as connection:
            connection.exec_driver_sql(_EVERY_OTHER)
        engine.dispose()
        yield
