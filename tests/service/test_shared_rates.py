"""Requests of one owner to several APIs, which count them together in Redis."""

import asyncio
import time
from pathlib import Path

import pytest
from redis import Redis

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


def test_no_window_of_any_begin_has_more_than_the_rate_allows() -> None:
    now = 0.0
    rates = Rates(1.0, None, lambda: now)
    assert accepted([rates], "ada", 1) == 1
    now = 9.0
    assert accepted([rates], "ada", 20) == 9
    now = 10.5
    assert accepted([rates], "ada", 20) == 1  # in place of the first one
    now = 19.5
    assert accepted([rates], "ada", 20) == 9


def test_a_clock_that_is_set_back_keeps_nobody_out(tmp_path: Path) -> None:
    """Requests of an hour to come would count until then."""
    broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
    broker.start()
    try:
        with Redis.from_url(broker.url) as redis:
            ahead = {str(number): time.time() + 3600.0 + number for number in range(10)}
            redis.zadd("jointplay:rates:ada", ahead)
            assert accepted([Rates(1.0, broker.url)], "ada", 20) in (10, 20)
            assert 1 <= redis.ttl("jointplay:rates:ada") <= 11
    finally:
        broker.stop()


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
