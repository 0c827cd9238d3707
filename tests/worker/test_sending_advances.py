"""Files that are sent or stored slowly: each piece counts as moving on, so no lease is given up."""

import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Self

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.solver.kinds import admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, BlockState, JobState, NewJob
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.object_stores.s3 import Bucket
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance, noted_target
from jointplay.worker.execute import Answer
from jointplay.worker.joined import computing
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from jointplay.worker.lease import Lease
from jointplay.worker.scratch.files import Scratch
from jointplay.worker.work import work_of
from tests.service_in_thread import serving

BLOCK = Block("01KZJ9W6P1M3QX8Y5T7R4B9C2R-0", "job", 0, 0, 1, BlockState.running, attempt=1)
MEBIBYTE = 2**20
JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.5, "certificate": False}


class Counting(Advance):
    """Counts how often somebody moved on."""

    def __init__(self) -> None:
        super().__init__()
        self.count = 0

    def note(self) -> None:
        super().note()
        self.count += 1


class Slow(AttemptFiles):
    """Says how often the attempt had moved on when each piece was taken."""

    def __init__(self, settings: Settings, advance: Counting) -> None:
        super().__init__(settings, BLOCK)
        self._advance = advance
        self.found: list[int] = []

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        super().put(name, self._seen(pieces))

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        super().append(name, offset, self._seen(pieces))

    def _seen(self, pieces: Iterable[bytes]) -> Iterator[bytes]:
        for piece in pieces:
            self.found.append(self._advance.count)
            yield piece


def test_each_piece_that_is_sent_is_an_advance(tmp_path: Path) -> None:
    here = Settings(data=tmp_path / "here", running="data")
    advance = Counting()
    slow = Slow(Settings(data=tmp_path / "there", running="data"), advance)
    scratch = Scratch(slow, here, BLOCK, advance)
    here.sealed_run(BLOCK.job, 1).put([bytes(3 * MEBIBYTE)])
    scratch.send_sealed()
    assert slow.found == [1, 2, 3]
    journal = here.running_folder(BLOCK.job) / "a1" / "parts" / "0"
    journal.parent.mkdir(parents=True)
    for content in (bytes(2 * MEBIBYTE), bytes(4 * MEBIBYTE)):
        with journal.open("ab") as file:
            file.write(content)
        before = advance.count
        slow.found.clear()
        scratch.send(scratch.take())
        assert slow.found == [before + 1 + piece for piece in range(len(content) // MEBIBYTE)]


def test_each_piece_that_is_sealed_is_an_advance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    admission = admit(JOB)
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    settings = Settings(data=tmp_path)
    advance, found = Counting(), list[int]()
    put = Folder.put

    def slowly(store: Folder, key: str, pieces: Iterable[bytes]) -> None:
        def seen() -> Iterator[bytes]:
            for piece in pieces:
                found.append(advance.count)
                yield piece

        put(store, key, seen())

    monkeypatch.setattr(Folder, "put", slowly)
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        catalogue.migrate()
        job = catalogue.submit(new).job
        claim = catalogue.claim_block(f"{job.id}-0", "worker", 60.0)
    assert claim is not None
    outcome = work_of(claim, settings).execute(lambda _: Answer.go_on, advance.note)
    assert outcome.state == "succeeded"
    assert len(found) > 10
    assert found == [*range(found[0], found[0] + len(found))]


class InBucket(AttemptFiles):
    """Keeps what is put in a bucket."""

    bucket = Bucket("//results/here?endpoint=http://127.0.0.1:1")

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        self.bucket.replace(name, pieces)


def test_each_piece_that_a_bucket_takes_is_an_advance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Objects are gathered first: nothing was heard of while they were sent."""
    advance, found = Counting(), list[int]()

    def put(_address: str, *, content: Iterable[bytes], **_: object) -> httpx.Response:
        found.extend(advance.count for _ in content)
        return httpx.Response(200)

    monkeypatch.setattr(httpx, "put", put)
    for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
        monkeypatch.setenv(name, "nobody")
    target = noted_target(StoredObject(InBucket.bucket, "sealed"), advance.note)
    target.put([bytes(12 * MEBIBYTE)])
    assert found == [*range(found[0], found[0] + 12)]
    found.clear()
    here = Settings(data=tmp_path, running="data")
    here.sealed_run(BLOCK.job, 1).put([bytes(6 * MEBIBYTE)])
    rows = here.running_folder(BLOCK.job) / "a1" / "parts" / "0"
    rows.parent.mkdir(parents=True)
    rows.write_bytes(bytes(7 * MEBIBYTE))
    scratch = Scratch(InBucket(here, BLOCK), here, BLOCK, advance)
    scratch.send_sealed()
    assert found == [*range(found[0], found[0] + 6)]
    found.clear()
    scratch.send(scratch.take())
    assert found == [*range(found[0], found[0] + 7)]


class Upload(Connection):
    """Says by how much the attempt moved on while each file of sealed results was sent."""

    def __init__(self, url: str, made: list[Counting]) -> None:
        super().__init__(url, None)
        self._made = made
        self.sealed: list[int] = []

    def write(
        self, block: Block, name: str, content: Iterable[bytes], size: int, digest: str, offset: int
    ) -> None:
        before = self._made[-1].count
        super().write(block, name, content, size, digest, offset)
        if name.startswith("sealed/"):
            self.sealed.append(self._made[-1].count - before)


def test_the_lease_of_a_joined_worker_hears_of_what_it_sends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[Counting] = []
    leased: list[Callable[[], None]] = []

    class Heard(Lease):
        def __enter__(self) -> Self:
            leased.append(self.advanced)
            super().__enter__()
            return self

    def advance() -> Counting:
        made.append(Counting())
        return made[-1]

    monkeypatch.setattr(computing, "Advance", advance)
    monkeypatch.setattr("jointplay.worker.block_run.Lease", Heard)
    settings = Settings(data=tmp_path)
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        catalogue.migrate()
        admission = admit(JOB)
        new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
        job = catalogue.submit(new).job.id
        with serving(create_app(settings)) as url, closing(Upload(url, made)) as upload:
            assert work(upload, threading.Event(), 0.5) == 1
        assert catalogue.get(job).state is JobState.succeeded
    assert leased == [made[0].note]
    (during,) = upload.sealed
    assert during >= 1
