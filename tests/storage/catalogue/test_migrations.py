import multiprocessing
from collections.abc import Callable
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory

from jointplay.storage.catalogue import schema, tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Broken, Unavailable
from jointplay.storage.catalogue.records import NewJob
from tests.postgresql_server import Server

LATER = (
    "ALTER TABLE job DROP COLUMN kept_for",
    "DROP INDEX ix_job_to_remove",
    "ALTER TABLE job DROP COLUMN deleted",
    "DROP TABLE installation",
    "DROP TABLE label",
    "DROP TABLE tally",
    "DROP INDEX ix_job_unserved",
    "DROP INDEX ix_outbox_queue_owner",
    "DROP TABLE share",
    "DROP INDEX ix_attempt_unsettled",
    "ALTER TABLE attempt DROP COLUMN account",
    "ALTER TABLE attempt DROP COLUMN charged",
    "ALTER TABLE outbox DROP COLUMN owner",
    "ALTER TABLE outbox DROP COLUMN turn",
    "CREATE INDEX ix_outbox_queue_due ON outbox (queue, due, block)",
    "DROP TABLE turn",
    "DROP INDEX ix_job_unmeasured",
    "DROP INDEX ix_job_owner_stored",
    "DROP INDEX ix_job_owner_id",
    "ALTER TABLE job DROP COLUMN owner",
    "ALTER TABLE batch DROP COLUMN owner",
    "DROP TABLE api_key",
    "ALTER TABLE job DROP COLUMN processor",
    "DROP TABLE worker",
    "ALTER TABLE job DROP COLUMN stored",
    "DROP TABLE usage",
    "UPDATE alembic_version SET version_num = '0001'",
)
"""Takes away what came after the first revision."""


@pytest.fixture(params=["sqlite", "postgresql"])
def nothing(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """Name a database without tables."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'new' / 'catalogue.sqlite'}"
    server: Server = request.getfixturevalue("postgresql")
    return server.new("template0")


def migrate(url: str) -> None:
    catalogue = Catalogue(url)
    catalogue.migrate()
    catalogue.ping()
    catalogue.close()


def test_migrations_build_exactly_the_tables_of_the_code(new_url: Callable[[], str]) -> None:
    catalogue = Catalogue(new_url())
    with catalogue.connections.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, tables.metadata) == []
    catalogue.close()


def test_the_code_knows_the_newest_revision() -> None:
    configuration = Config()
    configuration.set_main_option("script_location", "storage:migrations")
    assert ScriptDirectory.from_config(configuration).get_current_head() == schema.REVISION


def test_a_catalogue_to_which_a_newer_program_added_is_worked_with_and_left_as_it_is(
    new_url: Callable[[], str],
) -> None:
    catalogue = Catalogue(new_url())
    with catalogue.connections.writing() as connection:
        connection.exec_driver_sql("ALTER TABLE job ADD COLUMN newer TEXT")
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '0999'")
    catalogue.migrate()
    catalogue.ping()
    assert catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).created
    assert catalogue.flaws() == ()
    catalogue.close()


def test_a_catalogue_of_which_a_newer_program_took_something_away_is_refused(
    new_url: Callable[[], str],
) -> None:
    catalogue = Catalogue(new_url())
    with catalogue.connections.writing() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '1001'")
    assert not catalogue.is_migrated()
    with pytest.raises(RuntimeError, match="of a newer jointplay than this one; run that one"):
        catalogue.migrate()
    with pytest.raises(RuntimeError, match="at revision 1001"):
        catalogue.ping()
    assert catalogue.flaws() == ("is at revision 1001, of a newer jointplay than this one",)
    catalogue.close()


def test_a_catalogue_of_an_older_program_is_not_ready(new_url: Callable[[], str]) -> None:
    catalogue = Catalogue(new_url())
    with catalogue.connections.writing() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '0001'")
    assert not catalogue.is_migrated()
    with pytest.raises(RuntimeError, match="at revision 0001"):
        catalogue.ping()
    catalogue.close()


def test_the_first_revision_is_brought_to_the_newest(new_url: Callable[[], str]) -> None:
    catalogue = Catalogue(new_url())
    older = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).job
    with catalogue.connections.writing() as connection:
        if connection.dialect.name == "postgresql":
            connection.exec_driver_sql("DROP FUNCTION claim_block, claim_next")
        for statement in LATER:
            connection.exec_driver_sql(statement)
    catalogue.migrate()
    catalogue.ping()
    with catalogue.connections.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, tables.metadata) == []
    assert catalogue.get(older.id) == older
    job = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).job.id
    assert catalogue.claim_block(f"{job}-0", "worker", 30)
    catalogue.record_progress(f"{job}-0", 1, 30, time=1.0, fraction=0.5)
    catalogue.close()


def test_several_processes_may_migrate_at_once(nothing: str) -> None:
    url = nothing
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=migrate, args=(url,)) for _ in range(3)]
    for process in processes:
        process.start()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0]


def test_an_empty_database_is_not_ready(nothing: str) -> None:
    catalogue = Catalogue(nothing)
    catalogue.connections.make_database()
    with pytest.raises(Broken):
        catalogue.ping()
    catalogue.close()


def test_a_file_that_is_gone_is_missed_and_not_made_anew_in_sqlite(tmp_path: Path) -> None:
    file = tmp_path / "catalogue.sqlite"
    catalogue = Catalogue(f"sqlite:///{file}")
    catalogue.migrate()
    catalogue.close()
    file.rename(tmp_path / "elsewhere.sqlite")
    with pytest.raises(Unavailable, match="does not answer"):
        catalogue.ping()
    assert not file.exists()
    catalogue.close()
