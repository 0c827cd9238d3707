import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from jointplay.command_line.application import run
from jointplay.service.processes import running_service
from tests.service_in_thread import application, catalogue, http, service_url, settings
from tests.worker_by_hand import (
    finished_accuracy,
    finished_job,
    finished_study,
    finished_sweep,
    worker,
)


@pytest.fixture(scope="session", autouse=True)
def children_hear_ctrl_c() -> Iterator[None]:
    """Shells start background programs with Ctrl-C ignored, and their children inherit that."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


class Ended(NamedTuple):
    """End of a command."""

    code: int
    out: str
    err: str

    def line(self) -> str:
        """The one line on stderr."""
        assert self.err.count("\n") == 1, self.err
        return self.lines()[0]

    def lines(self) -> list[str]:
        """The lines on stderr: one for each thing that is wrong."""
        lines = self.err.splitlines()
        assert lines
        assert all(line.startswith("jointplay: ") for line in lines), self.err
        return lines


Jointplay = Callable[..., Ended]


@pytest.fixture
def jointplay(capsys: pytest.CaptureFixture[str]) -> Jointplay:
    """Run one command in this process."""

    def call(*arguments: object) -> Ended:
        code = run([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return Ended(code, out, err)

    return call


class Service(NamedTuple):
    """Broker, API, relay and two workers, as `jointplay serve` runs them."""

    url: str
    data: Path


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    data = tmp_path_factory.mktemp("service") / "data"
    with running_service(data, workers=2) as url:
        yield Service(url, data)
