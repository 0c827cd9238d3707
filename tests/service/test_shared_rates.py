"""Requests of one owner to several APIs, which count them together in Redis."""

import asyncio
import time
from pathlib import Path

import pytest

from jointplay.service.access.rates import Rates
from jointplay.service.problems import RequestRefused
from jointplay.service.processes.broker import Broker


def accepted(apis: list[Rates], owner: str, requests: int) -> int:
    """Send requests to one API after the other, and return how many were let in."""

    async def sent() -> int:
        refused = 0
        for number in range(requests):
            try:
                await apis[number % len(apis)].count(owner)
            except RequestRefused:
                refused += 1
        return requests - refused

    return asyncio.run(sent())


def test_no_window_of_any_begin_has_more_than_the_rate_allows(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now, begun = 0.0, time.time()
    monkeypatch.setattr(time, "time", lambda: begun + now)
    rates = Rates(1.0, None)
    assert accepted([rates], "ada", 1) == 1
    now = 9.0
    assert accepted([rates], "ada", 20) == 9
    now = 10.5
    assert accepted([rates], "ada", 20) == 1  # in place of the first one
    now = 19.5
    assert accepted([rates], "ada", 20) == 9


def test_three_apis_share_a_rate_and_do_without_redis(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
    broker.start()
    try:
        apis = [Rates(1.0, broker.url) for _ in range(3)]
        assert accepted(apis, "ada", 60) in (10, 20)  # of one window, or of two
        assert accepted(apis, "bob", 4) == 4
    finally:
        broker.stop()
    assert accepted(apis, "ada", 60) >= 30  # each lets in ten
    assert "counted by this process alone" in caplog.text
