"""Files of a running job in the data folder."""

from pathlib import Path

import pytest

from jointplay.storage.durable import PARTIAL
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.running_files.folder import InFolder
from tests.storage.running_files.contract import RunningFilesContract


class TestInFolder(RunningFilesContract):
    """The contract."""

    @pytest.fixture(autouse=True)
    def _begin(self, tmp_path: Path) -> None:
        self.path = tmp_path / "2R" / "JOB"

    def opened(self) -> RunningFiles:
        return InFolder(self.path)

    def raw(self) -> dict[str, bytes]:
        found = (path for path in self.path.rglob("*") if path.is_file())
        return {str(path.relative_to(self.path)): path.read_bytes() for path in found}

    def test_what_is_half_written_has_no_name(self) -> None:
        self.opened().put("a1/parts/1", [b"x"])
        (self.path / f"a1/parts/2{PARTIAL}").write_bytes(b"half")
        assert [*self.opened().names()] == ["a1/parts/1"]

    def test_a_folder_that_cannot_be_read_is_not_one_without_files(self) -> None:
        self.opened().put("a1/parts/1", [b"x"])
        with pytest.raises(OSError, match="too long"):
            list(self.opened().names("x" * 300))
