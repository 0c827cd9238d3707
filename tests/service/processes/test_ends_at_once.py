"""A process that ends while it is waited for: what it wrote itself is told."""

import sys
from pathlib import Path

import pytest

from jointplay.service.processes.child import Child, StartFailed

SAYS = "print('no address', flush=True); raise SystemExit(1)"


def reason(log: Path, program: str) -> str:
    """Return why a process that runs a program did not start."""
    child = Child("API", [sys.executable, "-c", program], log, {})
    child.start()
    with pytest.raises(StartFailed) as failed:
        child.await_answer(lambda: False, 60.0, lambda _seconds: None)
    return str(failed.value)


def test_what_it_wrote_is_told_and_nothing_of_the_process_before(tmp_path: Path) -> None:
    """The end of the log was told, which began with what an earlier start had written."""
    log = tmp_path / "api.log"
    log.write_text("the catalogue does not answer\n")
    for _ in range(2):  # the second start finds the lines of the first one, too
        assert reason(log, SAYS) == "the API ended at once:\nno address"
    assert log.read_text() == "the catalogue does not answer\n" + 2 * "no address\n"


def test_of_one_that_wrote_nothing_that_is_told(tmp_path: Path) -> None:
    log = tmp_path / "api.log"
    log.write_text("the catalogue does not answer\n")
    assert (
        reason(log, "raise SystemExit(1)") == f"the API ended at once, and wrote nothing to {log}"
    )
