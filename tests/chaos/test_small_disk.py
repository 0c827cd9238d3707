"""The disk that a campaign fills is its own, and as large as the campaign needs."""

import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.chaos.small_disk import on_small_disk, room_for

SIZE = "import os, sys; found = os.statvfs(sys.argv[1]); print(found.f_blocks * found.f_frsize)"


def test_longer_campaigns_have_larger_disks_and_short_ones_enough() -> None:
    assert room_for(1.0) == room_for(60.0) >= 2**28
    assert room_for(7200.0) == 2 * room_for(3600.0) > 2 * room_for(60.0)


def test_a_command_sees_a_disk_of_that_size_and_others_do_not(tmp_path: Path) -> None:
    folder, size = tmp_path / "data", room_for(600.0)
    asking = [sys.executable, "-c", SIZE, str(folder)]
    command = on_small_disk(folder, size, asking)
    if command == asking:
        pytest.skip("unshare and mount cannot make a disk here")
    assert int(subprocess.check_output(command)) == size
    assert int(subprocess.check_output(asking)) != size
