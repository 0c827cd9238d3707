"""Requests that are held, and those that are answered beside them."""

import asyncio
import logging
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Literal

import pytest
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.records.log_repetitions import Repetitions
from jointplay.service.access.concurrency import (
    BESIDE_KEYS,
    MOST,
    OF_HEALTH,
    WITHOUT_KEY,
    ConcurrencyLimit,
)
from jointplay.service.app import create_app
from jointplay.service.problems import handlers
from jointplay.storage.settings import Settings

PROGRESS = "/v1/worker/blocks/b/1/progress"


async def answers_at_once(scope: Scope, receive: Receive, send: Send) -> None:
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b""})


class Clients:
    """Clients that take nothing of their answers."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app
        self.tasks: list[asyncio.Task[None]] = []
        self.headers: dict[bytes, bytes] = {}  # of the last answer

    async def ask(self, path: str, headers: Mapping[bytes, bytes] | None = None) -> int:
        """Return the status of an answer, of which nothing more is taken."""
        status: asyncio.Future[int] = asyncio.get_running_loop().create_future()

        async def send(message: Message) -> None:
            if not status.done():
                self.headers = dict(message["headers"])
                status.set_result(message["status"])
            await asyncio.Event().wait()

        async def receive() -> Message:
            await asyncio.Event().wait()
            raise AssertionError

        scope = {
            "type": "http",
            "http_version": "1.1",
            "method": "GET",
            "scheme": "http",
            "server": ("127.0.0.1", 8000),
            "client": ("127.0.0.1", 50000),
            "path": path,
            "raw_path": path.encode(),
            "root_path": "",
            "query_string": b"",
            "headers": [(b"host", b"127.0.0.1"), *(headers or {}).items()],
        }
        self.tasks.append(asyncio.ensure_future(self.app(scope, receive, send)))  # type: ignore[arg-type]
        return await status

    async def statuses(
        self, count: int, path: str, headers: Mapping[bytes, bytes] | None = None
    ) -> list[int]:
        return [await self.ask(path, headers) for _ in range(count)]


@asynccontextmanager
async def clients_of(app: ASGIApp) -> AsyncIterator[Clients]:
    clients = Clients(app)
    try:
        yield clients
    finally:
        for task in clients.tasks:
            task.cancel()
        await asyncio.gather(*clients.tasks, return_exceptions=True)


@pytest.mark.parametrize(("keys", "most"), [("required", BESIDE_KEYS), ("none", WITHOUT_KEY)])
def test_callers_without_a_key_have_a_part(
    tmp_path: Path, keys: Literal["required", "none"], most: int
) -> None:
    async def asked() -> list[int]:
        async with clients_of(create_app(Settings(data=tmp_path, keys=keys))) as clients:
            return await clients.statuses(most + 2, "/v1/laws")

    assert asyncio.run(asked()) == [200] * most + [503] * 2


def test_most_turns_are_for_those_with_a_key_where_one_is_required() -> None:
    assert BESIDE_KEYS < MOST / 3


def test_health_is_told_however_many_workers_are_answered() -> None:
    async def asked() -> tuple[list[int], list[int]]:
        async with clients_of(ConcurrencyLimit(answers_at_once, [], keys=False)) as clients:
            held = await clients.statuses(MOST, PROGRESS)
            return held, await clients.statuses(OF_HEALTH, "/healthz")

    held, health = asyncio.run(asked())
    assert held == [200] * (MOST - OF_HEALTH) + [503] * OF_HEALTH
    assert health == [200] * OF_HEALTH


def test_workers_hold_their_blocks_however_many_others_are_answered() -> None:
    async def asked() -> tuple[list[int], int]:
        async with clients_of(ConcurrencyLimit(answers_at_once, [], keys=False)) as clients:
            held = await clients.statuses(MOST, "/v1/jobs", {b"authorization": b"Bearer a"})
            return held, await clients.ask(PROGRESS)

    held, progress = asyncio.run(asked())
    assert 503 in held
    assert progress == 200


def test_many_refusals_are_one_warning_that_counts_them(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    repetitions = Repetitions(3600.0)
    monkeypatch.setattr(handlers, "_REPETITIONS", repetitions)

    async def asked() -> None:
        async with clients_of(ConcurrencyLimit(answers_at_once, [], keys=True)) as clients:
            await clients.statuses(BESIDE_KEYS + 50, "/v1/shared/a-secret/zarr")
            repetitions.period = 0.0
            await clients.ask("/v1/scenes")

    asyncio.run(asked())
    first, last = caplog.messages
    assert "GET /v1/shared/... was answered with 503" in first
    assert last.startswith("GET /v1/scenes was answered with 503")
    assert last.endswith("(49 others before it)")


def test_a_refusal_has_a_line_and_an_id_as_other_answers(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)

    async def asked() -> bytes:
        settings = Settings(data=tmp_path, keys="required", log_format="json")
        async with clients_of(create_app(settings)) as clients:
            await clients.statuses(BESIDE_KEYS + 1, "/openapi.json")
            return clients.headers[b"x-request-id"]

    assert asyncio.run(asked())
    assert any(line.startswith("GET") and line.endswith(" 503") for line in caplog.messages)
