"""``jointplay worker`` without --join: the worker that `jointplay serve` starts, by itself."""

import subprocess
import sys
from contextlib import closing
from datetime import datetime
from pathlib import Path

import pytest

from jointplay.command_line.application import run
from jointplay.command_line.exits import Stopped
from jointplay.command_line.worker import _moment
from jointplay.service.processes.broker import Broker
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.waiting import until

COMMAND = [sys.executable, "-P", "-m", "jointplay", "worker", "--settings"]


def test_a_worker_takes_its_addresses_from_a_file_and_tells_of_its_device(tmp_path: Path) -> None:
    broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
    settings = tmp_path / "settings"
    settings.write_text(f"JOINTPLAY_DATA={tmp_path}\nJOINTPLAY_REDIS_URL={broker.url}\n")
    broker.start()
    try:
        with closing(Catalogue(Settings(data=tmp_path).catalogue_url)) as books:
            books.migrate()
            command = [*COMMAND, settings.name, "--device", "host", "--processes", "2"]
            with subprocess.Popen(command, cwd=tmp_path) as worker:
                try:
                    until(lambda: len(books.workers()) == 2 or worker.poll() is not None)
                    told, _ = books.workers_at_work()
                finally:
                    worker.terminate()
            assert worker.returncode == 0
            assert (told.device, told.lanes) == ("this processor", 128)
            assert told.rate is not None
            assert told.rate > 0.0
    finally:
        broker.stop()


def test_a_worker_without_its_device_does_not_start(tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    settings.write_text(f"JOINTPLAY_DATA={tmp_path}\nJOINTPLAY_REDIS_URL=redis://127.0.0.1:9\n")
    with closing(Catalogue(Settings(data=tmp_path).catalogue_url)) as books:
        books.migrate()
    arguments = [*COMMAND, settings.name, "--device", "cuda:9999"]
    ended = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True)
    assert ended.returncode == 1
    assert "JOINTPLAY_DEVICE 'cuda:9999' cannot be opened" in ended.stderr


@pytest.mark.parametrize(
    ("line", "arguments", "complaint"),
    [
        ("", [], "--join URL is missing, or JOINTPLAY_REDIS_URL"),
        ("JOINTPLAY_LEESE=30", [], "JOINTPLAY_LEESE: Extra inputs are not permitted"),
        ("JOINTPLAY_LEASE=6", [], "must be at least twice JOINTPLAY_HEARTBEAT"),
        ("JOINTPLAY_REDIS_URL=redis://h", ["--idle", "9"], "are for a worker with --join"),
        ("", ["--device", "gpu"], "JOINTPLAY_DEVICE: String should match pattern"),
        ("", ["--device", "cuda:9999", "--join", "https://h"], "'cuda:9999' cannot be opened"),
    ],
)
def test_what_is_missing_or_wrong_is_said_in_a_line(
    line: str,
    arguments: list[str],
    complaint: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name, value in (("SETTINGS", ""), ("DEVICE", "cpu")):  # are taken away again
        monkeypatch.setenv(f"JOINTPLAY_{name}", value)
    file = tmp_path / "settings"
    file.write_text(f"{line}\n")
    assert run(["worker", "--settings", str(file), *arguments]) == 2
    assert complaint in capsys.readouterr().err


def test_a_file_that_is_not_there_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("JOINTPLAY_SETTINGS", "/no/such/file")
    assert run(["worker"]) == 2
    assert "JOINTPLAY_SETTINGS is /no/such/file, which is no file" in capsys.readouterr().err


@pytest.mark.parametrize("date", ["20261123", "2026-11-23", "20261123T00:00:00"])
def test_a_date_without_dashes_is_no_number_of_seconds(date: str) -> None:
    assert _moment(date) == datetime(2026, 11, 23).timestamp()
    assert _moment("1795392000") == 1795392000.0
    for wrong in ("123", "20261399", "soon"):
        with pytest.raises(Stopped, match="must be a time such as"):
            _moment(wrong)
