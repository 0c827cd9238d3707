"""Whether a process ended is known for certain, or not said."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator

import pytest

from jointplay.worker.process_name import has_ended, own_name

NAMED = "from jointplay.worker.process_name import own_name; print(own_name(), flush=True); input()"


@pytest.fixture
def process() -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, "-P", "-c", NAMED],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        yield process
        process.kill()


def name_of(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline().strip()


def test_a_process_has_ended_when_it_is_killed_also_before_its_parent_looks(
    process: subprocess.Popen[str],
) -> None:
    name = name_of(process)
    assert not has_ended(name)
    process.kill()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    assert has_ended(name)  # nobody has asked how it ended: its id is still taken
    process.wait()
    assert has_ended(name)


def test_a_process_that_is_stopped_has_not_ended(process: subprocess.Popen[str]) -> None:
    name = name_of(process)
    process.send_signal(signal.SIGSTOP)
    os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
    assert not has_ended(name)


def test_a_later_process_of_the_same_id_is_another() -> None:
    host, pid, started, space = own_name().split(":", 3)
    assert not has_ended(own_name())
    assert has_ended(f"{host}:{pid}:{int(started) - 1}:{space}")


def test_nothing_is_said_of_processes_of_other_users(monkeypatch: pytest.MonkeyPatch) -> None:
    host, pid, started, space = own_name().split(":", 3)

    def refuse(_process: int, _signal: int) -> None:
        raise PermissionError

    monkeypatch.setattr(os, "kill", refuse)
    assert not has_ended(f"{host}:{pid}:{int(started) - 1}:{space}")


@pytest.mark.parametrize("name", ["worker", "host:1", "host:1:1", "host:1:1:", "host:1:1:other:5"])
def test_nothing_is_said_of_processes_elsewhere(name: str) -> None:
    assert not has_ended(name)


@pytest.mark.parametrize("pid", ["x", "", "0", "-1", str(2**31), "9" * 30, "１"])
def test_nothing_is_said_of_names_that_a_worker_has_made_up(pid: str) -> None:
    """Those that join choose theirs, and the relay asks about each of them."""
    host, _, started, space = own_name().split(":", 3)
    assert not has_ended(f"{host}:{pid}:{started}:{space}")


def test_nothing_is_said_of_a_worker_that_joined_with_a_key() -> None:
    """It could ask about the processes of the service's machine."""
    host, pid, started, space = own_name().split(":", 3)
    assert has_ended(f"{host}:{pid}:{int(started) - 1}:{space}")
    assert not has_ended(f"ab12@{host}:{pid}:{int(started) - 1}:{space}")
