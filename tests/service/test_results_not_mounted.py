"""Results that joined workers send while the disk for them is not mounted."""

from pathlib import Path

import pytest

from tests.joined_by_hand import SWING, installation, sealed_run


def test_nothing_is_taken_in_place_of_a_disk_that_is_not_mounted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It would be hidden beneath the disk, and the job would have succeeded without results."""
    disk, elsewhere = tmp_path / "disk", tmp_path / "elsewhere"
    monkeypatch.setenv("JOINTPLAY_RESULTS_URL", f"file:{disk}")
    with installation("folder", tmp_path / "data") as service:
        job = service.submit(SWING)
        held = service.claim()
        disk.rename(elsewhere)
        disk.mkdir()
        for answer in (held.put("sealed/1", sealed_run(2.0)), held.finish()):
            assert answer.status_code == 503
            assert "Retry-After" in answer.headers
        assert not [*disk.iterdir()]
        disk.rmdir()
        elsewhere.rename(disk)
        assert held.put("sealed/1", sealed_run(2.0)).status_code == 204
        assert held.finish().status_code == 200
        service.require_right(job)
