"""Large files of a worker that joined: right into the bucket, or through the service."""

import os
from base64 import b64encode
from collections.abc import Iterable, Iterator
from hashlib import md5, sha256
from pathlib import Path

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block
from jointplay.storage.settings import Settings
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.connection import Connection, ResultsRefused
from jointplay.worker.joined.files import FilesOfService
from jointplay.worker.joined.protocol import Drop
from tests.joined_by_hand import sealed
from tests.seaweedfs_server import BUCKET, running_store
from tests.service_in_thread import client_of, serving
from tests.worker_by_hand import Worker

CONTENT = os.urandom(2**20 + 7)
ROWS = "a1/rows/history-0.zip"
NOBODY = "http://127.0.0.1:9"
"""The port of a service that discards, which is not there."""


class Counting(Connection):
    """A connection that counts what goes through the service."""

    written = 0

    def write(
        self, block: Block, name: str, content: Iterable[bytes], size: int, digest: str, offset: int
    ) -> None:
        self.written += 1
        super().write(block, name, content, size, digest, offset)


class Attempt:
    """A block that a worker holds, and how it sends files of it."""

    def __init__(self, url: str, catalogue: Catalogue, settings: Settings) -> None:
        with client_of(url) as http:
            worker = Worker(http, catalogue, settings)
            claim = worker.start(worker.submit())
        self.block, self.document = claim.block, claim.job.spec
        self.settings = settings
        self.connection = Counting(url, None)
        self.files = FilesOfService(self.connection, BucketOfService(self.connection), self.block)

    def stored(self, name: str) -> bytes:
        return b"".join(AttemptFiles(self.settings, self.block).read(name))

    def objects(self) -> list[str]:
        return sorted(
            self.settings.object_store.list(f"running/{self.block.job[-2:]}/{self.block.job}/")
        )


@pytest.fixture(scope="module")
def endpoint() -> Iterator[str]:
    with running_store() as endpoint:
        yield endpoint


@pytest.fixture(params=["", NOBODY])
def elsewhere(request: pytest.FixtureRequest) -> str:
    """Address of the bucket that workers are told; empty: its own."""
    return str(request.param)


@pytest.fixture
def attempt(endpoint: str, tmp_path: Path, elsewhere: str) -> Iterator[Attempt]:
    settings = Settings(
        data=tmp_path,
        results_url=f"s3://{BUCKET}/{tmp_path.name}?endpoint={endpoint}",
        results_redirect=elsewhere or endpoint,
        keys="none",
    )
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        attempt = Attempt(url, catalogue, settings)
        yield attempt
        attempt.connection.close()
    catalogue.close()


def pieces() -> list[bytes]:
    return [CONTENT[: 2**20], CONTENT[2**20 :]]


def drop(name: str = ROWS, content: bytes = CONTENT) -> Drop:
    digests = {"sha256": sha256(content).hexdigest(), "md5": md5(content).hexdigest()}
    return Drop(name=name, size=len(content), **digests)


def test_they_arrive_whether_or_not_the_bucket_is_in_reach(
    attempt: Attempt, elsewhere: str
) -> None:
    for name, content in ((ROWS, CONTENT), ("sealed/1", sealed(attempt.document))):
        attempt.files.put(name, [content[: 2**20], content[2**20 :]])
        attempt.files.put(name, [content])  # as if the first answer had been lost
        assert attempt.stored(name) == content
    assert attempt.connection.written == (4 if elsewhere else 0)
    (only,) = attempt.objects()
    assert only.endswith("/a1/rows/history-0.zip+000000000000")


@pytest.mark.parametrize("elsewhere", [""], indirect=True)
def test_only_what_is_whole_and_right_becomes_a_file(attempt: Attempt) -> None:
    connection, block = attempt.connection, attempt.block
    assert not connection.taken(block, drop())  # nothing was put
    address = connection.offered(block, drop())
    assert address is not None
    for wrong in (CONTENT[:-1], CONTENT + b"x"):  # the address is for so many bytes
        assert httpx.put(address, content=wrong, trust_env=False).status_code == 403
    for wrong in (bytes(len(CONTENT)), CONTENT[:-1] + bytes([CONTENT[-1] ^ 1])):
        httpx.put(address, content=wrong, trust_env=False).raise_for_status()
        assert not connection.taken(block, drop())
        with pytest.raises(FileNotFoundError):
            attempt.stored(ROWS)
    other = address.replace(drop().sha256, sha256(b"other").hexdigest())
    assert httpx.put(other, content=b"other", trust_env=False).status_code == 403
    httpx.put(address, content=CONTENT, trust_env=False).raise_for_status()
    assert connection.taken(block, drop())
    assert attempt.stored(ROWS) == CONTENT
    other = "a1/rows/history-1.zip"
    encrypted = drop(other).model_copy(update={"md5": "0" * 32})  # the store has another
    httpx.put(address, content=CONTENT, trust_env=False).raise_for_status()
    assert connection.taken(block, encrypted)
    assert attempt.stored(other) == CONTENT
    garbage = drop("sealed/1")
    httpx.put(address, content=CONTENT, trust_env=False).raise_for_status()
    with pytest.raises(ResultsRefused, match="sealed/1 is cut off"):
        connection.taken(block, garbage)
    with pytest.raises(FileNotFoundError):
        attempt.stored("sealed/1")


@pytest.mark.parametrize("elsewhere", [""], indirect=True)
def test_files_that_change_and_small_ones_go_through_the_service(attempt: Attempt) -> None:
    for name in ("a1/parts/00000001", "a1/documents.zip", "block0-a1"):
        assert attempt.connection.offered(attempt.block, drop(name)) is None
        assert not attempt.connection.taken(attempt.block, drop(name))
        attempt.files.put(name, pieces())
        assert attempt.stored(name) == CONTENT
    attempt.files.put(ROWS, [b"few"])
    assert (attempt.stored(ROWS), attempt.connection.written) == (b"few", 4)


@pytest.mark.parametrize("elsewhere", [""], indirect=True)
def test_what_a_late_attempt_puts_is_no_file(attempt: Attempt) -> None:
    connection, block = attempt.connection, attempt.block
    address = connection.offered(block, drop("sealed/1"))
    assert address is not None
    connection.report(block, "release")
    httpx.put(address, content=CONTENT, trust_env=False).raise_for_status()
    for ask in (connection.taken, connection.offered):
        with pytest.raises(Fenced):
            ask(block, drop("sealed/1"))
    with pytest.raises(FileNotFoundError):
        attempt.stored("sealed/1")
    told = b64encode(sha256(CONTENT).digest()).decode()
    with pytest.raises(Fenced):
        connection.write(block, ROWS, pieces(), len(CONTENT), f"sha-256=:{told}:", 0)
