"""Catalogues in every database: a test that asks for one is run in each."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue
from tests.postgresql_server import Server


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture(scope="session")
def empty_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("catalogue") / "empty.sqlite"
    catalogue = Catalogue(f"sqlite:///{path}")
    catalogue.migrate()
    catalogue.close()
    return path


@pytest.fixture
def new_file(empty_file: Path, tmp_path: Path) -> Callable[[], str]:
    """Make catalogues in SQLite."""
    count = 0

    def url() -> str:
        nonlocal count
        count += 1
        path = tmp_path / f"catalogue{count}.sqlite"
        shutil.copyfile(empty_file, path)
        return f"sqlite:///{path}"

    return url


@pytest.fixture
def new_database(postgresql: Server) -> Iterator[Callable[[], str]]:
    """Make catalogues in PostgreSQL."""
    made: list[str] = []

    def url() -> str:
        made.append(postgresql.new())
        return made[-1]

    yield url
    for one in made:
        postgresql.drop(one)


@pytest.fixture(params=["sqlite", "postgresql"])
def new_url(request: pytest.FixtureRequest) -> Callable[[], str]:
    """Make catalogues in the database of this run of the test."""
    made: Callable[[], str] = request.getfixturevalue(
        "new_file" if request.param == "sqlite" else "new_database"
    )
    return made


@pytest.fixture
def catalogue(new_url: Callable[[], str], clock: Clock) -> Iterator[Catalogue]:
    catalogue = Catalogue(new_url(), clock=clock)
    yield catalogue
    catalogue.close()
