"""Files of an attempt that are sent from a folder of its own."""

import os
from pathlib import Path

from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.records import Block, BlockState
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.scratch.files import Scratch

BLOCK = Block("01KZJ9W6P1M3QX8Y5T7R4B9C2R-0", "job", 0, 0, 1, BlockState.running, attempt=1)


def open_files() -> int:
    return len(os.listdir("/dev/fd"))


def test_what_was_sent_is_not_opened_for_each_restart_point_again(tmp_path: Path) -> None:
    """A run of days has thousands of files of rows, and a process may have 1024 open."""
    here = Settings(data=tmp_path / "here", running="data")
    there = AttemptFiles(Settings(data=tmp_path / "there", running="data"), BLOCK)
    scratch = Scratch(there, here, BLOCK, Advance())
    rows = here.running_folder(BLOCK.job) / "a1" / "rows"
    rows.mkdir(parents=True)
    for number in range(20):
        (rows / f"history-{number}.zip").write_bytes(b"rows")
    before = open_files()
    scratch.send(scratch.take())
    assert open_files() == before
    (rows / "history-20.zip").write_bytes(b"more")
    taken = scratch.take()
    assert [name for name, _ in taken.files] == ["a1/rows/history-20.zip"]
    assert open_files() == before + 1
    scratch.send(taken)
    assert [*there.running.names("a1/rows")] == [
        *AttemptFiles(here, BLOCK).running.names("a1/rows")
    ]
    assert open_files() == before
