from collections.abc import Iterator
from pathlib import Path

import pytest
from jobs import IMPATIENT, Service, catalogue_of

from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(data=tmp_path / "data")


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    with catalogue_of(settings) as catalogue:
        yield catalogue


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    settings = Settings(data=tmp_path_factory.mktemp("service") / "data")
    with (
        catalogue_of(settings) as catalogue,
        running_service(settings.data, workers=2, environment=IMPATIENT),
    ):
        yield Service(settings, catalogue)
