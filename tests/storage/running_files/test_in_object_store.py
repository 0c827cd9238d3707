"""Files of a running job in an object store; a bucket's are tried with what else buckets do."""

from pathlib import Path

import pytest

from jointplay.storage.object_stores.folder import Folder
from tests.storage.running_files.contract import InObjectStoreContract


class TestInObjectStore(InObjectStoreContract):
    """The contract."""

    @pytest.fixture(autouse=True)
    def _begin(self, tmp_path: Path) -> None:
        self.object_store, self.prefix = Folder(str(tmp_path)), "running/2R/JOB"
