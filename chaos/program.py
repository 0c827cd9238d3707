"""A campaign in a process of its own, which has a small disk of its own if that is to be full."""

import json
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from jointplay.chaos.faults import FAULTS
from jointplay.chaos.report import Report
from jointplay.chaos.small_disk import on_small_disk, room_for
from jointplay.service.processes import StartFailed


def names() -> list[str]:
    """Return the names of all faults."""
    return list(FAULTS)


def carry_out(
    folder: Path,
    *,
    seed: int,
    duration: float,
    faults: Sequence[str],
    workers: int,
    servers: tuple[str, str] = ("", ""),
) -> Report:
    """Run a campaign in a folder, which is there and empty, as the servers are. Returns its report.

    Raises
    ------
    StartFailed
        It broke off; its own words are on stderr.
    KeyboardInterrupt
        By Ctrl-C or SIGTERM; nothing that it started runs any more.
    """
    plan = {
        "folder": str(folder),
        "seed": seed,
        "duration": duration,
        "faults": list(faults),
        "workers": workers,
        "servers": servers,
    }
    command = [sys.executable, "-P", "-m", "jointplay.chaos", json.dumps(plan)]
    if "disk-full" in faults:
        command = on_small_disk(folder / "data", room_for(duration), command)
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        code, told = _told(command)
    finally:
        signal.signal(signal.SIGTERM, before)
    if code != 0:
        raise StartFailed(f"the campaign broke off; what it left is in {folder}")
    report = Report.of_document(json.loads(told))
    report.kept = str(folder)
    return report


def _told(command: Sequence[str]) -> tuple[int, bytes]:
    """Run a program that ends with its standard input. Returns its exit code and its output."""
    with subprocess.Popen(  # noqa: S603 - our own program
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        process_group=0,  # Ctrl-C reaches us alone
    ) as program:
        try:
            told = program.stdout.read() if program.stdout else b""
        finally:
            if program.stdin:
                program.stdin.close()
            program.wait()
    return program.returncode, told
