"""A process that starts slowly, as on a machine with much else to do, is waited for."""

import socket
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest

from jointplay.service.processes import child
from jointplay.service.processes.child import Child, StartFailed
from jointplay.service.processes.health import Health
from tests.waiting import until

PATIENCE = 60.0


class Clock:
    """Goes on by ten seconds whenever somebody pauses."""

    def __init__(self) -> None:
        self.now = 0.0

    def monotonic(self) -> float:
        return self.now

    def pause(self, _seconds: float) -> None:
        self.now += 10.0


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(child, "time", clock)
    return clock


@pytest.fixture
def starting(tmp_path: Path) -> Iterator[Child]:
    """A process that lives, and whose name is API."""
    process = Child("API", ["/bin/sleep", "1000"], tmp_path / "log", {})
    process.start()
    yield process
    process.await_end(0.0)


def test_one_that_computes_is_waited_for(
    clock: Clock, starting: Child, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was ended after a minute, however far it was."""
    looks = count()
    monkeypatch.setattr(child, "processor_time", lambda _pid: next(looks) / 100)
    starting.await_answer(lambda: clock.now > 3 * PATIENCE, PATIENCE, clock.pause)
    with pytest.raises(StartFailed, match="the API did not answer in 310 s"):
        starting.await_answer(lambda: False, PATIENCE, clock.pause)  # though it computes


def test_one_that_does_nothing_is_not(
    clock: Clock, starting: Child, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(child, "processor_time", lambda _pid: 0.5)
    with pytest.raises(StartFailed, match="the API did not answer in 70 s"):
        starting.await_answer(lambda: False, PATIENCE, clock.pause)


def test_an_answer_that_takes_long_is_one() -> None:
    """The API was asked anew every second, and had to answer within one."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        health = Health(listener)
        for _ in range(10):
            assert not health.is_good()
        asked, _ = listener.accept()
        listener.setblocking(False)
        with pytest.raises(BlockingIOError):
            listener.accept()  # it was asked once
        assert asked.recv(1000).startswith(b"GET /healthz HTTP/1.1")
        asked.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n")
        until(health.is_good)
        asked.close()


@pytest.mark.parametrize("answer", [b"", b"HTTP/1.1 503 Busy\r\nContent-Length: 0\r\n\r\n"])
def test_another_answer_is_asked_for_again(answer: bytes) -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        health = Health(listener)
        assert not health.is_good()
        refused, _ = listener.accept()
        refused.sendall(answer)
        refused.close()
        listener.settimeout(0.05)
        again: list[socket.socket] = []

        def asked_again() -> bool:
            assert not health.is_good()
            try:
                again.append(listener.accept()[0])
            except TimeoutError:
                return False
            return True

        until(asked_again)
        health.close()
        again.pop().close()
