"""Files of a running job as objects of a place; those of a bucket are tried with other buckets."""

from pathlib import Path

import pytest

from jointplay.storage.places.folder import Folder
from tests.storage.running_files.contract import InPlaceContract


class TestInPlace(InPlaceContract):
    """The contract."""

    @pytest.fixture(autouse=True)
    def _begin(self, tmp_path: Path) -> None:
        self.place, self.prefix = Folder(str(tmp_path)), "running/2R/JOB"
