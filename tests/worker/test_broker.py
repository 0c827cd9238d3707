import os
import stat
from pathlib import Path

import pytest
from kombu import Connection
from redis import Redis

from jointplay.service.processes import StartFailed
from jointplay.service.processes.broker import Broker, answers, server_binary, socket_path
from jointplay.worker.app import broker_url


def test_it_needs_no_disk_and_refuses_to_drop_any_message(broker: Broker) -> None:
    redis = Redis.from_url(broker.url, decode_responses=True)
    assert redis.config_get("appendonly")["appendonly"] == "no"
    assert redis.config_get("save")["save"] == ""
    assert redis.config_get("maxmemory-policy")["maxmemory-policy"] == "noeviction"
    assert redis.config_get("port")["port"] == "0"
    redis.close()


def test_nobody_else_may_talk_to_it(broker: Broker) -> None:
    path = Path(broker.url.removeprefix("unix://"))
    assert stat.S_IMODE(path.stat().st_mode) == 0o700
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


def test_it_begins_empty_and_leaves_nothing(tmp_path: Path) -> None:
    for _ in range(2):
        broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
        broker.start()
        redis = Redis.from_url(broker.url)
        assert redis.get("what") is None
        redis.set("what", b"gone")
        redis.close()
        broker.stop()
        assert list((tmp_path / "broker").iterdir()) == []
        assert not answers(broker.url)


@pytest.mark.parametrize("name", ["a%20b", "a#b", "a?b", "dä ta", "a@b:c"])
def test_its_folder_may_have_any_name(tmp_path: Path, name: str) -> None:
    """A service in a folder with a # in its name gave up: its broker did not answer in 15 s."""
    folder = tmp_path / name / "broker"
    broker = Broker(folder, tmp_path / "broker.log")
    broker.start()
    assert (folder / "redis.sock").is_socket()
    with Connection(broker_url(broker.url)) as celerys:
        celerys.ensure_connection(max_retries=1, timeout=10)
    broker.stop()


def test_a_long_path_gets_a_short_socket(tmp_path: Path) -> None:
    folder = tmp_path / ("long" * 30)
    broker = Broker(folder, tmp_path / "broker.log")
    path = Path(broker.url.removeprefix("unix://"))
    broker.start()
    assert answers(broker.url)
    assert len(os.fsencode(path)) <= 100
    broker.stop()
    assert not path.parent.exists()
    assert socket_path(tmp_path / "b") == tmp_path / "b" / "redis.sock"


def test_a_server_on_the_path_is_taken_first(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    ours = tmp_path / "redis-server"
    ours.symlink_to(server_binary())
    monkeypatch.setenv("PATH", str(tmp_path))
    assert server_binary() == ours
    preferred = tmp_path / "valkey-server"
    preferred.symlink_to(ours)
    assert server_binary() == preferred


def test_a_server_that_cannot_start_says_why(tmp_path: Path) -> None:
    folder = tmp_path / "broker"
    broker = Broker(folder, tmp_path / "broker.log")
    folder.rmdir()
    with pytest.raises(StartFailed, match="ended at once"):
        broker.start()
    broker.stop()
