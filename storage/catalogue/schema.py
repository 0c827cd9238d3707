"""Bringing a database to the present schema, when a process starts."""

from collections.abc import Iterator

from sqlalchemy import Connection, inspect, text

from jointplay.storage.catalogue import functions, tables
from jointplay.storage.catalogue.errors import WrongRevision

REVISION = "0016"
"""The newest migration; a test compares it with the folder storage/migrations. One that takes
something away which programs before it need is called by the next thousand: 1001 after 0016."""


def present_revision(connection: Connection) -> str | None:
    """Return the revision the database is at; none if it is empty."""
    if not inspect(connection).has_table("alembic_version"):
        return None
    found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
    return None if found is None else str(found)


def serves(found: str | None) -> bool:
    """Tell whether this program can work at a revision: its own, or one that only added to it."""
    return found is not None and found >= REVISION and found[0] == REVISION[0]


def upgrade(connection: Connection) -> None:
    """Make all tables, or run the missing migrations, inside the caller's unit of writing.

    Raises
    ------
    WrongRevision
        The database is of a newer program that took something away which this one needs.
    """
    from alembic import command
    from alembic.config import Config

    configuration = Config()
    configuration.set_main_option("script_location", "jointplay.storage:migrations")
    configuration.attributes["connection"] = connection
    found = present_revision(connection)
    if found is not None and found > REVISION:
        raise WrongRevision(f"the catalogue {_newer(found)}; run that one")
    if found is None:
        tables.metadata.create_all(connection)
        functions.make(connection)
        command.stamp(configuration, "head")
    else:
        command.upgrade(configuration, "head")


def flaws(connection: Connection) -> tuple[str, ...]:
    """Return sentences on a schema that is not the present one, and on pages that are damaged."""
    found = present_revision(connection)
    if found is None:
        return ("has no tables; jointplay serve makes them",)
    if found < REVISION:
        return (f"is at revision {found}; jointplay serve brings it to {REVISION}",)
    if not serves(found):
        return (_newer(found),)
    if lacking := [*_lacking(connection)]:
        return (f"lacks {', '.join(lacking)}",)
    if connection.dialect.name != "sqlite":
        return ()
    said = connection.execute(text("PRAGMA integrity_check(5)")).scalars()
    return tuple(f"is damaged: {sentence}" for sentence in said if sentence != "ok")


def _newer(found: str) -> str:
    return f"is at revision {found}, of a newer jointplay than this one"


def _lacking(connection: Connection) -> Iterator[str]:
    """Name what a database has no more of what was made in it, as one restored from a part."""
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    for found in compare_metadata(MigrationContext.configure(connection), tables.metadata):
        if isinstance(found, tuple) and found[0].startswith("add_"):
            what = found[0].removeprefix("add_").replace("fk", "foreign key").replace("_", " ")
            *_, made = found
            yield f"{what} {made.name or made.table.name}"
    yield from (f"function {name}" for name in functions.lacking(connection))
