"""`jointplay serve` keeps its processes running and leaves none behind."""

import json
import os
import signal
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pytest

from jointplay.chaos.small_disk import on_small_disk
from jointplay.service.processes import StartFailed, WrongSetting, running_service, serve
from tests.waiting import descendants, is_alive, until

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
SERVE = "from pathlib import Path; from jointplay.service.processes import serve; {call}"


def healthy(url: str) -> bool:
    try:
        with urllib.request.urlopen(f"{url}/healthz", timeout=5) as answer:
            return bool(json.load(answer)["status"] == "ok")
    except OSError:
        return False


@contextmanager
def served(data: Path, *, as_json: bool = False) -> Iterator[tuple[subprocess.Popen[str], str]]:
    call = f"serve('127.0.0.1', 0, Path({str(data)!r}), 1, as_json={as_json})"
    with subprocess.Popen(
        [sys.executable, "-c", SERVE.format(call=call)], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout is not None
            line = process.stdout.readline()
            assert "http" in line, (data / "logs" / "api.log").read_text()
            url = json.loads(line)["url"] if as_json else line.split(" at ")[1].split()[0]
            yield process, url
        finally:
            process.kill()


def end_cleanly(process: subprocess.Popen[str], data: Path, number: signal.Signals) -> None:
    started = descendants(process.pid)
    assert len(started) >= 4  # broker, API, relay, worker
    process.send_signal(number)
    assert process.wait() == 0
    assert not [pid for pid in started if is_alive(pid)]
    assert not list((data / "broker").glob("*.sock"))


class Service(NamedTuple):
    process: subprocess.Popen[str]
    url: str
    data: Path


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """One service of several tests, which ends cleanly."""
    data = tmp_path_factory.mktemp("service") / "data"
    with served(data) as (process, url):
        yield Service(process, url, data)
        end_cleanly(process, data, signal.SIGTERM)


def test_it_ends_cleanly_by_ctrl_c(tmp_path: Path) -> None:
    with served(tmp_path / "data", as_json=True) as (process, url):
        assert healthy(url)
        end_cleanly(process, tmp_path / "data", signal.SIGINT)


def test_nothing_outlives_a_killed_supervisor(tmp_path: Path) -> None:
    with served(tmp_path / "data") as (process, _):
        started = descendants(process.pid)
        process.kill()
        until(lambda: not any(is_alive(pid) for pid in started))


def test_a_killed_process_is_started_again(service: Service) -> None:
    def find(words: str) -> int | None:
        started = descendants(service.process.pid)
        return min((pid for pid, command in started.items() if words in command), default=None)

    def find_new(words: str, before: int) -> bool:
        return find(words) not in (None, before)

    for words in ("processes.api", "jointplay.worker.relay", "broker/redis.sock"):
        before = find(words)
        assert before is not None
        os.kill(before, signal.SIGKILL)
        until(partial(find_new, words, before))
    until(lambda: healthy(service.url))


def test_a_folder_has_one_service(service: Service) -> None:
    until(lambda: healthy(service.url))
    with pytest.raises(WrongSetting, match="--data") as caught:
        serve("127.0.0.1", 0, service.data, 1)
    assert service.url in str(caught.value)
    assert healthy(service.url)


def test_a_background_service_ends_with_its_parent(tmp_path: Path) -> None:
    script = (
        "import time; from pathlib import Path\n"
        "from jointplay.service.processes import running_service\n"
        f"with running_service(Path({str(tmp_path / 'data')!r})) as url:\n"
        "    print(url, flush=True); time.sleep(600)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True
    ) as parent:
        try:
            assert parent.stdout is not None
            assert healthy(parent.stdout.readline().strip())
            started = descendants(parent.pid)
            assert len(started) >= 5
        finally:
            parent.kill()
    until(lambda: not any(is_alive(pid) for pid in started))


def test_a_taken_port_is_said(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(WrongSetting, match=f"port {port}"):
            serve("127.0.0.1", port, tmp_path / "data", 1)


def test_a_redis_that_does_not_answer_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("JOINTPLAY_REDIS_URL", "redis://127.0.0.1:1/0")
    with (
        pytest.raises(StartFailed, match="no Redis answers at JOINTPLAY_REDIS_URL"),
        running_service(tmp_path / "data"),
    ):
        pass


def test_a_full_disk_is_said(tmp_path: Path) -> None:
    """The API ended at once, and its log was empty: there was no room for a word."""
    data = tmp_path / "data"
    call = SERVE.format(call=f"serve('127.0.0.1', 0, Path({str(data)!r}), 1)")
    command = on_small_disk(data, 100_000, [sys.executable, "-c", call])
    if len(command) == 3:
        pytest.skip("unshare and mount cannot make a disk here")
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert f"the disk with {data / 'logs'} is full" in ended.stderr
