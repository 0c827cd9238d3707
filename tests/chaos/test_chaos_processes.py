"""Faults find the processes that they are for."""

from pathlib import Path

from jointplay.chaos.installation import Installation
from jointplay.chaos.processes import ROLES
from tests.waiting import until


def test_every_role_has_a_process_and_none_is_left_after_all_were_killed(tmp_path: Path) -> None:
    installation = Installation(tmp_path, workers=1, device=True)
    installation.start()
    try:
        # the children of the worker are the last to be there
        until(lambda: {one.role for one in installation.running()} >= {*ROLES})
    finally:
        installation.kill()
    assert installation.running() == []
