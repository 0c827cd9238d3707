"""A catalogue that is broken is found, and nothing else is asked of it."""

import os
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation import findings
from jointplay.storage.settings import Settings
from tests.postgresql_server import Server
from tests.storage.reconciliation.installation import Installed


def overwrite(path: Path) -> None:
    path.write_bytes(b"no database at all" * 500)


def cut(path: Path) -> None:
    os.truncate(path, 8192)


def change_the_revision(path: Path, revision: str) -> None:
    with closing(sqlite3.connect(path)) as database:
        database.execute(f"UPDATE alembic_version SET version_num = '{revision}'")
        database.commit()


@pytest.mark.parametrize(
    ("harm", "found"),
    [
        (overwrite, "cannot be read"),
        (cut, "cannot be read"),
        (lambda path: change_the_revision(path, "9999"), "newer jointplay"),
        (lambda path: change_the_revision(path, "0000"), "jointplay serve brings it to"),
    ],
)
def test_of_a_catalogue_that_is_broken_nothing_else_is_asked(
    tmp_path: Path, harm: Callable[[Path], None], found: str
) -> None:
    settings = Settings(data=tmp_path)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    catalogue.close()
    for path in tmp_path.glob("catalogue.sqlite-*"):
        path.unlink()
    harm(tmp_path / "catalogue.sqlite")
    with closing(Catalogue(settings.catalogue_url)) as broken:
        told = [*findings(settings, broken)]
    assert {one.where for one in told} == {"catalogue"}
    assert found in told[0].found
    assert all(one.mend is None for one in told)


def test_a_catalogue_whose_index_is_not_that_of_its_rows_is_found(in_a_folder: Installed) -> None:
    """Questions to such a database are answered, and some of the answers are wrong."""
    in_a_folder.catalogue.close()
    path = in_a_folder.settings.data / "catalogue.sqlite"
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b"succeeded", b"succeedex", 1))
    (found, *_) = in_a_folder.look()
    assert found.found.startswith("is damaged: ")
    assert "backup" in str(found.advice)


@pytest.mark.parametrize(
    ("loss", "found"),
    [
        ("DROP INDEX ix_job_label_id", "index ix_job_label_id"),
        ("DROP TABLE outbox", "table outbox"),
        ("DROP FUNCTION claim_block", "function claim_block"),
        ("ALTER TABLE block DROP CONSTRAINT fk_block_job", "foreign key fk_block_job"),
    ],
)
def test_a_database_that_was_restored_from_a_part_is_found(
    postgresql: Server, tmp_path: Path, loss: str, found: str
) -> None:
    url = postgresql.new()
    postgresql.ask(loss, url.rpartition("/")[2])
    catalogue = Catalogue(url)
    (told,) = findings(Settings(data=tmp_path, catalogue_url=url), catalogue)
    assert (told.where, told.found.startswith("lacks ")) == ("catalogue", True)
    assert found in told.found
    assert "backup" in str(told.advice)
    catalogue.close()
    postgresql.drop(url)
