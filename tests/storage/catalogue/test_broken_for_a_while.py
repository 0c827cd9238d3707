"""A database that is damaged, moved or restored: units are refused, and nothing is lost."""

import os
import shutil
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Broken, Unavailable
from jointplay.storage.catalogue.records import NewJob, Solver

NEW = NewJob("simulate", {}, "d" * 64, "1")


def rename(catalogue: Catalogue, old: str, new: str) -> None:
    with catalogue.connections.writing() as connection:
        connection.exec_driver_sql(f"ALTER TABLE {old} RENAME TO {new}")


@pytest.mark.parametrize("table", ["job", "block", "worker"])
def test_while_a_table_is_gone_as_during_a_restoration_units_are_refused(
    catalogue: Catalogue, table: str
) -> None:
    job = catalogue.submit(NEW).job.id
    assert catalogue.claim_block(f"{job}-0", "worker", 60.0) is not None
    rename(catalogue, table, "away")
    with pytest.raises(Broken):
        catalogue.heartbeat(f"{job}-0", 1, 60.0)
    rename(catalogue, "away", table)
    catalogue.heartbeat(f"{job}-0", 1, 60.0)
    catalogue.note_worker("worker", Solver("1", "x86_64"))


def test_an_index_that_another_thread_makes_meanwhile_refuses_nobody(
    new_file: Callable[[], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    url = new_file()
    index, asked = Path(f"{url.removeprefix('sqlite:///')}-shm"), os.access

    def made_meanwhile(path: str, mode: int) -> bool:
        answer = asked(path, mode)
        if path == str(index):
            index.touch()
        return answer

    with closing(Catalogue(url)) as catalogue:
        index.unlink(missing_ok=True)
        monkeypatch.setattr(os, "access", made_meanwhile)
        assert catalogue.submit(NEW).job.id


@pytest.mark.parametrize("size", [0, 8192])
def test_a_file_that_lost_its_pages_is_broken(new_file: Callable[[], str], size: int) -> None:
    url = new_file()
    os.truncate(url.removeprefix("sqlite:///"), size)
    with closing(Catalogue(url)) as catalogue, pytest.raises(Broken):
        catalogue.submit(NEW)


def test_nothing_is_accepted_into_a_file_that_was_moved_or_replaced(
    new_file: Callable[[], str],
) -> None:
    """Connections that are open write on where nobody will look for it."""
    url = new_file()
    file = Path(url.removeprefix("sqlite:///"))
    with closing(Catalogue(url)) as catalogue:
        first = catalogue.submit(NEW).job.id
        moved = file.rename(file.with_name("moved"))
        with pytest.raises(Unavailable, match="does not answer"):
            catalogue.submit(NEW)
        shutil.copyfile(new_file().removeprefix("sqlite:///"), file)
        with pytest.raises(Unavailable, match="another file"):
            catalogue.submit(NEW)
        moved.replace(file)
        second = catalogue.submit(NEW).job.id
        assert [job.id for job in catalogue.jobs().jobs] == [second, first]
