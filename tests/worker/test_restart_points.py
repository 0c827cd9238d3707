from pathlib import Path

import pytest

from jointplay.records.checkpoint import UnusableCheckpoint
from jointplay.worker.checkpoints import RestartPoint


def test_the_store_of_a_restart_point_is_beside_it(tmp_path: Path) -> None:
    """A worker elsewhere may have sent it."""
    path = tmp_path / "block0-a1"
    RestartPoint(b"s", b"r", tmp_path / "a1", 1, 0.5, 0.1).store(path)
    assert RestartPoint.load(path).folder == tmp_path / "a1"
    RestartPoint(b"s", b"r", Path(".."), 1, 0.5, 0.1).store(path)
    with pytest.raises(UnusableCheckpoint, match="none beside it"):
        RestartPoint.load(path)
