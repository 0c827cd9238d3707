"""Answers to a worker that joined which no service of ours gives: of what is between them."""

import asyncio
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.responses import HTMLResponse
from sqlalchemy import update

from jointplay.service.app import create_app
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import (
    Block,
    BlockEnd,
    BlockState,
    Claim,
    Job,
    NewJob,
    Solver,
    Verdict,
)
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance
from jointplay.worker.holding import Refused
from jointplay.worker.joined.attempt import JoinedAttempt
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.files import FilesOfService
from jointplay.worker.joined.protocol import Answered, ClaimRequest, Drop, Files
from jointplay.worker.scratch.files import Scratch
from tests.service_in_thread import serving

BLOCK = Block("01KZJ9W6P1M3QX8Y5T7R4B9C2R-0", "job", 0, 0, 1, BlockState.running, attempt=1)
LEASE = 1.0
"""Seconds, after which an answer is of no use any more."""


@pytest.fixture
def connection() -> Iterator[Connection]:
    """A connection to something that has another service's pages, or none, for a while."""
    with serving(FastAPI()) as url, closing(Connection(url, None)) as connection:
        yield connection


def test_what_a_proxy_answers_for_a_while_ends_no_block(connection: Connection) -> None:
    for ask in (
        lambda: connection.report(BLOCK, "heartbeat"),
        lambda: connection.ask(BLOCK, Files),
        lambda: [*connection.read(BLOCK, "block0-a1")],
        lambda: connection.write(BLOCK, "a1/parts/0", [b""], 0, "", 0),
        lambda: connection.remove(BLOCK, "a1/parts/0"),
    ):
        with pytest.raises(Unavailable, match="status 404"):
            ask()


@pytest.fixture
def maintained() -> Iterator[Connection]:
    """A connection to a proxy that answers everything with a page, as if all was well."""
    away = FastAPI()

    @away.api_route("/{path:path}", methods=["GET", "POST", "PUT", "DELETE"])
    def page() -> HTMLResponse:
        return HTMLResponse("<html>We are back soon.</html>")

    with serving(away) as url, closing(Connection(url, None)) as connection:
        yield connection


def test_a_page_in_place_of_an_answer_ends_nothing(maintained: Connection, tmp_path: Path) -> None:
    drop = Drop(name="sealed/1", size=1, sha256="0" * 64, md5="0" * 32)
    request = ClaimRequest(program="0", worker="w", version="1", processor="p", wait=0.0)
    files = FilesOfService(maintained, BucketOfService(maintained), BLOCK)
    scratch = Scratch(files, Settings(data=tmp_path), BLOCK, Advance())
    job = Job("simulate", {}, "d" * 64, "1", id="job", created=0.0)
    attempt = JoinedAttempt(maintained, Claim(BLOCK, job), scratch)
    for ask in (
        lambda: maintained.claim(request),
        lambda: maintained.claim_beside(BLOCK, Solver("1", "p"), 1),
        lambda: maintained.ask(BLOCK, Files),
        lambda: [*maintained.read(BLOCK, "block0-a1")],
        lambda: maintained.write(BLOCK, "a1/parts/0", [b""], 0, "", 0),
        lambda: maintained.remove(BLOCK, "a1/parts/0"),
        lambda: maintained.offered(BLOCK, drop),
        lambda: maintained.taken(BLOCK, drop),
        lambda: attempt.heartbeat(BLOCK.id, 1, LEASE),
        lambda: attempt.finish(BLOCK.id, 1, BlockEnd(BlockState.done)),
        lambda: attempt.release(BLOCK.id, 1),
    ):
        with pytest.raises(Unavailable, match="text/html"):
            ask()


def test_a_document_of_something_else_ends_nothing() -> None:
    other = FastAPI()

    @other.post("/v1/worker/claims")
    def answer() -> dict[str, str]:
        return {"status": "away"}

    request = ClaimRequest(program="0", worker="w", version="1", processor="p", wait=0.0)
    with (
        serving(other) as url,
        closing(Connection(url, None)) as connection,
        pytest.raises(Unavailable, match="none of a service"),
    ):
        connection.claim(request)


def test_an_address_where_there_is_no_service_is_refused(connection: Connection) -> None:
    with pytest.raises(Refused, match="status 404"):
        connection.claim(
            ClaimRequest(program="0", worker="w", version="1", processor="p", wait=0.0)
        )


def test_no_answer_is_waited_for_until_the_lease_is_over(tmp_path: Path) -> None:
    """An API that is lost says nothing; another one is asked while the block is still held."""
    late = FastAPI()

    @late.post("/v1/worker/blocks/{block}/{attempt}/{what}")
    async def answer() -> Answered:
        await asyncio.sleep(LEASE)
        return Answered(verdict=Verdict.go_on)

    with serving(late) as url, closing(Connection(url, None)) as connection:
        files = FilesOfService(connection, BucketOfService(connection), BLOCK)
        scratch = Scratch(files, Settings(data=tmp_path), BLOCK, Advance())
        job = Job("simulate", {}, "d" * 64, "1", id="job", created=0.0)
        attempt = JoinedAttempt(connection, Claim(BLOCK, job), scratch)
        with pytest.raises(Unavailable):
            attempt.heartbeat(BLOCK.id, 1, LEASE)
        attempt.record_progress(BLOCK.id, 1, LEASE, time=0.0, fraction=0.0)  # waits for nothing
        with pytest.raises(Unavailable):
            attempt.heartbeat(BLOCK.id, 1, LEASE)


def test_progress_goes_with_the_next_word_and_who_computes_hears_the_answer(
    tmp_path: Path, catalogue: Catalogue
) -> None:
    new = NewJob("simulate", {}, "d" * 64, "1")
    job = catalogue.submit(new).job.id
    claim = catalogue.claim_block(f"{job}-0", "lab:1", 60.0)
    assert claim is not None
    settings = Settings(data=tmp_path / "data")
    block, told = claim.block, {"time": 1.0, "fraction": 0.5, "steps": 7}
    with serving(create_app(settings)) as url, closing(Connection(url, None)) as connection:
        files = FilesOfService(connection, BucketOfService(connection), block)
        attempt = JoinedAttempt(connection, claim, Scratch(files, settings, block, Advance()))

        def reached() -> tuple[float, int | None, str | None]:
            (stored,) = catalogue.blocks(job)
            return stored.progress_fraction, stored.progress_steps, stored.checkpoint

        assert attempt.record_progress(block.id, 1, 60.0, **told) is Verdict.go_on
        assert reached() == (0.0, None, None)
        attempt.record_checkpoint(block.id, 1, watermark=3, checkpoint="block0-a1")
        assert reached() == (0.5, 7, "block0-a1")
        attempt.record_progress(block.id, 1, 60.0, **told | {"fraction": 0.75})
        assert catalogue.workers() == {}
        catalogue.note_worker("lab:1", Solver("1", "p"))
        with catalogue.connections.writing() as database:
            database.execute(update(tables.worker).values(seen=0.0))
        catalogue.request_cancel(job)
        attempt.heartbeat(block.id, 1, 60.0)
        assert reached() == (0.75, 7, "block0-a1")
        assert [*catalogue.workers()] == ["lab:1"]  # heard of, however long its block takes
        assert attempt.record_progress(block.id, 1, 60.0, **told) is Verdict.cancel
        catalogue.release(block.id, 1)
        for ask in (attempt.heartbeat, attempt.record_progress):
            more = told if ask == attempt.record_progress else {}
            with pytest.raises(Fenced):
                ask(block.id, 1, 60.0, **more)
