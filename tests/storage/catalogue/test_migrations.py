import multiprocessing
from pathlib import Path

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import create_engine

from jointplay.storage.catalogue import Catalogue, NewJob, schema, tables


def migrate(url: str) -> None:
    catalogue = Catalogue(url)
    catalogue.migrate()
    catalogue.ping()
    catalogue.close()


def test_migrations_build_exactly_the_tables_of_the_code(empty_catalogue: Path) -> None:
    catalogue = Catalogue(f"sqlite:///{empty_catalogue}")
    with catalogue._connections.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, tables.metadata) == []
    catalogue.close()


def test_the_code_knows_the_newest_revision() -> None:
    configuration = Config()
    configuration.set_main_option("script_location", "storage:migrations")
    assert ScriptDirectory.from_config(configuration).get_current_head() == schema.REVISION


def test_jobs_of_the_first_schema_are_kept(tmp_path: Path) -> None:
    engine = create_engine(f"sqlite:///{tmp_path / 'old.sqlite'}")
    configuration = Config()
    configuration.set_main_option("script_location", "storage:migrations")
    with engine.begin() as connection:
        configuration.attributes["connection"] = connection
        command.upgrade(configuration, "0001")
        connection.exec_driver_sql(
            "INSERT INTO job (id, kind, owner, spec, digest, solver_version, result_schema, state,"
            " progress_time, progress_fraction, attempt, created)"
            " VALUES ('A', 'simulate', '', '{\"duration\": 2}', 'd', '0', 1, 'succeeded',"
            " 2, 1, 1, 5)"
        )
    engine.dispose()
    catalogue = Catalogue(f"sqlite:///{tmp_path / 'old.sqlite'}")
    catalogue.migrate()
    job = catalogue.get("A")
    assert (job.spec, job.state, job.activity) == ({"duration": 2}, "succeeded", None)
    assert catalogue.submit_batch([NewJob("simulate", {}, "d" * 64, "1")]).batch.count == 1
    catalogue.close()


def test_several_processes_may_migrate_at_once(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'new' / 'catalogue.sqlite'}"
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=migrate, args=(url,)) for _ in range(3)]
    for process in processes:
        process.start()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0]


def test_an_empty_database_is_not_ready(tmp_path: Path) -> None:
    catalogue = Catalogue(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    with pytest.raises(Exception, match="alembic_version"):
        catalogue.ping()
    catalogue.close()
