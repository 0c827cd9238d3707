"""Bodies of requests while they arrive: where they are, and for how long."""

import asyncio
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import httpx
import pytest
from fastapi import Request
from starlette.types import Message

from jointplay.service import body
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.workers import file_body
from jointplay.service.workers.uploads import Kept

JSON = {"Content-Type": "application/json"}
LONG = b" " * (4 * body.SHORT)


def test_a_long_body_finds_the_disk_for_passing_bodies_full(
    http: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "TemporaryFile", lambda **_: Path("/dev/full").open("r+b"))  # noqa: SIM115
    answer = http.post("/v1/jobs", content=LONG, headers=JSON)
    assert (answer.status_code, answer.json()["type"]) == (507, "/problems/disk-full")
    assert answer.headers["Retry-After"] == "30"


def test_a_long_body_finds_no_folder_for_passing_bodies(
    http: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", "/nowhere")
    answer = http.post("/v1/jobs", content=LONG, headers=JSON)
    assert (answer.status_code, answer.headers["Retry-After"]) == (503, "5")


def test_other_requests_go_on_while_a_body_is_written_to_disk(
    http: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    def runs_a_loop() -> bool:
        with suppress(RuntimeError):
            return bool(asyncio.get_running_loop())
        return False

    written_by: list[bool] = []
    make = tempfile.TemporaryFile

    class Watched:
        """A file that notes whether whoever writes it runs an event loop."""

        def __init__(self, file: IO[bytes]) -> None:
            self.file = file

        def write(self, content: bytes) -> int:
            written_by.append(runs_a_loop())
            return self.file.write(content)

        def __getattr__(self, name: str) -> Any:
            return getattr(self.file, name)

    def made(**named: Any) -> Any:
        of_the_clock = named.get("dir") is not None  # which may look at its files' times meanwhile
        return make(**named) if of_the_clock else Watched(make(**named))

    monkeypatch.setattr(tempfile, "TemporaryFile", made)
    assert http.post("/v1/jobs", content=LONG, headers=JSON).status_code == 400
    assert written_by
    assert not any(written_by)


def test_a_word_of_a_worker_holds_its_turn_for_some_seconds_whatever_it_says_of_its_length(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(body, "SLOWEST", 1e6)
    (word,) = [one.dependency for one in body.WordBody.__metadata__]  # type: ignore[attr-defined]

    async def silent() -> Message:
        await asyncio.Event().wait()
        raise AssertionError

    headers = [(b"content-type", b"application/json"), (b"content-length", b"60000000")]
    request = Request({"type": "http", "method": "POST", "headers": headers}, silent)
    with pytest.raises(RequestRefused) as refused:
        asyncio.run(asyncio.wait_for(word(request), 3600.0))
    assert refused.value.kind is kinds.BODY_TOO_SLOW
    assert refused.value.detail == "The body did not arrive within 5 s."


@pytest.mark.parametrize("told", [[(b"content-length", b"8000000")], []], ids=["told", "chunked"])
def test_a_body_holds_its_turn_as_long_as_it_keeps_up_whatever_its_length_is_said_to_be(
    monkeypatch: pytest.MonkeyPatch, told: list[tuple[bytes, bytes]]
) -> None:
    """One that was said to have 8 MB, or no length, could send nothing for 95 s."""
    monkeypatch.setattr(body, "SLOWEST", 1e4)
    read = body._json_body(body.LARGEST_BODY, 0.2)
    sent: list[int] = []

    async def dripping() -> Message:
        if len(sent) == 3:
            await asyncio.Event().wait()
        sent.append(1000)  # for which it has a tenth of a second more
        return {"type": "http.request", "body": b" " * 1000, "more_body": True}

    headers = [(b"content-type", b"application/json"), *told]
    request = Request({"type": "http", "method": "POST", "headers": headers}, dripping)
    with pytest.raises(RequestRefused) as refused:
        asyncio.run(asyncio.wait_for(read(request), 30.0))
    assert refused.value.kind is kinds.BODY_TOO_SLOW


def test_a_long_body_that_keeps_up_may_take_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(body, "SLOWEST", 1.0)
    read, length = body._json_body(body.LARGEST_BODY, 0.05), 1000
    pieces = iter([b" "] * length)

    async def steady() -> Message:
        await asyncio.sleep(0.001)
        piece = next(pieces, b"")
        return {"type": "http.request", "body": piece, "more_body": bool(piece)}

    headers = [(b"content-type", b"application/json")]
    request = Request({"type": "http", "method": "POST", "headers": headers}, steady)
    assert asyncio.run(read(request)) == b" " * length


def test_a_file_of_a_worker_whose_machine_was_lost_is_given_up(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Its room was kept, and its turn held, for as long as its length would have allowed: hours."""
    monkeypatch.setattr(file_body, "PATIENCE", 0.1)
    sent: list[bytes] = []

    async def lost() -> Message:
        if sent:
            await asyncio.Event().wait()
        sent.append(b"first bytes")
        return {"type": "http.request", "body": sent[0], "more_body": True}

    headers = [(b"content-length", b"500000000")]
    request = Request({"type": "http", "method": "PUT", "headers": headers}, lost)

    async def taken() -> None:
        async with file_body.arrived(request, tmp_path, Kept(500_000_000)):
            raise AssertionError

    with pytest.raises(RequestRefused) as refused:
        asyncio.run(asyncio.wait_for(taken(), 30.0))
    assert refused.value.kind is kinds.BODY_TOO_SLOW
