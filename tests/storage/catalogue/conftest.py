import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture(scope="session")
def empty_catalogue(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("catalogue") / "empty.sqlite"
    catalogue = Catalogue(f"sqlite:///{path}")
    catalogue.migrate()
    catalogue.close()
    return path


@pytest.fixture
def new_url(empty_catalogue: Path, tmp_path: Path) -> Callable[[], str]:
    count = 0

    def url() -> str:
        nonlocal count
        count += 1
        path = tmp_path / f"catalogue{count}.sqlite"
        shutil.copyfile(empty_catalogue, path)
        return f"sqlite:///{path}"

    return url


@pytest.fixture
def catalogue(new_url: Callable[[], str], clock: Clock) -> Iterator[Catalogue]:
    catalogue = Catalogue(new_url(), clock=clock)
    yield catalogue
    catalogue.close()
