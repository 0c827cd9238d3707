from collections.abc import Iterator
from pathlib import Path

import pytest
from one_block import JOB

from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings


@pytest.fixture(scope="module")
def admission() -> Admission:
    admission = admit(JOB)
    assert isinstance(admission, Admission)
    # a block that is told to stop while it compiles has no restart point yet
    kernel = ready_kernel(admission.scene, admission.job["formulation"], admission.method)
    compile_tangents(kernel)
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
