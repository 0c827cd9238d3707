from collections.abc import Iterator
from pathlib import Path

import pytest
from one_block import JOB

from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings


@pytest.fixture(scope="module")
def admission() -> Admission:
    admission = admit(JOB)
    assert isinstance(admission, Admission)
    return admission


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(data=tmp_path, progress_period=1e-3)  # a restart point with every slice


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()
