"""Bringing a database to the present schema, when a process starts."""

from sqlalchemy import Connection, inspect, text

REVISION = "0003"  # the newest migration; a test compares it with the folder storage/migrations


def present_revision(connection: Connection) -> str | None:
    """Return the revision the database is at; none if it is empty."""
    if not inspect(connection).has_table("alembic_version"):
        return None
    found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
    return None if found is None else str(found)


def upgrade(connection: Connection) -> None:
    """Run the missing migrations inside the caller's unit of writing."""
    from alembic import command
    from alembic.config import Config

    configuration = Config()
    configuration.set_main_option("script_location", "jointplay.storage:migrations")
    configuration.attributes["connection"] = connection
    command.upgrade(configuration, "head")
