"""A campaign in a process of its own, which has a small disk of its own where it can."""

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from jointplay.chaos.faults import FAULTS
from jointplay.chaos.report import Report
from jointplay.service.processes import StartFailed

_SMALLEST_DISK, _GROWTH = 2**28, 2**20
"""Bytes of a disk that is to be full: for a short campaign, and for each second of a longer one."""


def names() -> list[str]:
    """Return the names of all faults."""
    return list(FAULTS)


def carry_out(
    folder: Path, *, seed: int, duration: float, faults: Sequence[str], workers: int
) -> Report:
    """Run a campaign in a folder, which is there and empty, and return its report.

    Raises
    ------
    StartFailed
        It broke off; its own words are on stderr.
    """
    plan = {
        "folder": str(folder),
        "seed": seed,
        "duration": duration,
        "faults": list(faults),
        "workers": workers,
    }
    command = [sys.executable, "-P", "-m", "jointplay.chaos", json.dumps(plan)]
    if "disk-full" in faults:
        command = _with_a_small_disk(folder / "data", command, _disk_for(duration))
    done = subprocess.run(  # noqa: S603 - our own program
        command, stdout=subprocess.PIPE, check=False
    )
    if done.returncode != 0:
        raise StartFailed(f"the campaign broke off; what it left is in {folder}")
    report = Report.of_document(json.loads(done.stdout))
    report.kept = str(folder)
    return report


def _disk_for(duration: float) -> int:
    """Return the bytes of a disk that has room for what is computed in a campaign, s."""
    return max(_SMALLEST_DISK, int(_GROWTH * duration))


def _with_a_small_disk(data: Path, command: list[str], size: int) -> list[str]:
    """Return the command that sees a small file system of its own at `data`, if it can have one.

    It needs root, or a system that lets users make name spaces; the disk goes with the command.
    """
    alone = ["unshare", "--map-root-user", "--mount", "--"]
    mounting = f"mount -t tmpfs -o size={size} jointplay-chaos"
    inside = [*alone, "sh", "-ec", f'{mounting} "$0"; exec "$@"', str(data)]
    data.mkdir()
    try:
        subprocess.run([*inside, "true"], check=True, capture_output=True)  # noqa: S603
    except (OSError, subprocess.CalledProcessError):
        return command
    return [*inside, *command]
