"""FairSemaphore for what keeps a thread for long."""

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx
import pytest
from fastapi import Request
from starlette.requests import ClientDisconnect

from jointplay import figures
from jointplay.service.fair_semaphore import DRAWN_AT_ONCE, FairSemaphore, slot_for


def test_many_figures_of_one_leave_threads_for_others(
    http: httpx.Client, service_url: str, finished_job: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All threads that answer requests were drawing: heartbeats of workers waited behind them."""
    drawn, begun = threading.Event(), threading.Semaphore(0)

    def slowly(*_: Any) -> bytes:
        begun.release()
        drawn.wait(60.0)
        return b"a figure"

    monkeypatch.setattr(figures, "render", slowly)
    address = f"{service_url}/v1/jobs/{finished_job}/figures/outputs.svg"
    with ThreadPoolExecutor(60) as pool:
        try:
            asked = [
                pool.submit(httpx.get, address, timeout=90, trust_env=False) for _ in range(60)
            ]
            for _ in range(DRAWN_AT_ONCE):
                assert begun.acquire(timeout=60.0)
            assert http.get("/v1/jobs", timeout=20.0).status_code == 200
        finally:
            drawn.set()
        assert {one.result().status_code for one in asked} == {200}


def test_owners_have_slots_in_turn_and_who_leaves_has_none() -> None:
    async def happened() -> list[str]:
        slots, order = FairSemaphore(1), []

        async def work(owner: str) -> None:
            async with slots.slot(owner):
                order.append(owner)
                await asyncio.sleep(0)

        async with slots.slot("first"):
            some = [asyncio.create_task(work(name)) for name in ("a1", "a1", "a1", "b", "c", "b")]
            await asyncio.sleep(0)
            some[4].cancel()  # c
            await asyncio.sleep(0)
        await asyncio.gather(*some, return_exceptions=True)
        async with asyncio.timeout(5.0), slots.slot("last"):
            order.append("last")
        return order

    assert asyncio.run(happened()) == ["a1", "b", "a1", "b", "a1", "last"]


def test_a_place_that_is_given_to_one_who_goes_is_given_on() -> None:
    async def happened() -> None:
        slots = FairSemaphore(1)

        async def work() -> None:
            async with slots.slot("a"):
                pass

        async with slots.slot("first"):
            waits = asyncio.create_task(work())
            await asyncio.sleep(0)
        waits.cancel()  # its turn has come, and it has not gone on yet
        await asyncio.gather(waits, return_exceptions=True)
        async with asyncio.timeout(5.0), slots.slot("last"):
            pass

    asyncio.run(happened())


def test_nothing_is_made_for_who_has_left_meanwhile() -> None:
    async def gone() -> dict[str, str]:
        return {"type": "http.disconnect"}

    async def happened() -> None:
        slots, asked = FairSemaphore(1), Request({"type": "http"}, gone)
        with pytest.raises(ClientDisconnect):
            async with slot_for(asked, slots):
                pytest.fail("it was made")
        async with asyncio.timeout(5.0), slots.slot("last"):
            pass

    asyncio.run(happened())
