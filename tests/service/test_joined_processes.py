"""Processes of a worker that joined: they outlast neither a full disk badly, nor their parent."""

import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from pathlib import Path

import httpx
import pytest

from jointplay.service.access import authentication
from jointplay.service.app import create_app
from jointplay.solver.kinds import admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.counters import PUBLISHED, PUBLISHING
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings
from jointplay.worker.holding import Refused
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from tests.service.guarded import SWING
from tests.service_in_thread import serving
from tests.waiting import descendants, is_alive, until

WORKER = [sys.executable, "-P", "-m", "jointplay", "worker", "--processes", "2", "--join"]


@contextmanager
def served(data: Path) -> Iterator[tuple[str, Catalogue]]:
    """Give the address of a service and its catalogue, when it answers."""
    settings = Settings(data=data)
    with serving(create_app(settings)) as url, closing(Catalogue(settings.catalogue_url)) as books:
        assert httpx.get(f"{url}/readyz", trust_env=False, timeout=60.0).is_success
        yield url, books


def test_a_block_for_which_there_is_no_room_is_put_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    draining = threading.Event()
    with served(tmp_path) as (url, books):
        monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "lacking"))
        job = books.submit(NewJob("simulate", {}, "d" * 64, SOLVER_VERSION)).job.id
        with closing(Connection(url, None)) as connection, ThreadPoolExecutor(1) as threads:
            working = threads.submit(work, connection, draining, None)
            try:
                until(lambda: any(one.outcome for one in books.attempts(job)) or working.done())
            finally:
                draining.set()
            working.result()
        assert {one.outcome for one in books.attempts(job)} == {"put-off"}
        assert (books.get(job).activity or "").startswith("waiting for")


def test_a_key_revoked_in_mid_block_ends_the_worker_with_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(authentication, "_REMEMBERED", 0.0)
    settings = Settings(data=tmp_path, keys="required")
    draining = threading.Event()
    with serving(create_app(settings)) as url, closing(Catalogue(settings.catalogue_url)) as books:
        books.migrate()
        job = admit({**SWING, "duration": 1e5, "output_step": 1e5, "tolerance": 1e-12})
        new = NewJob("simulate", job.job, job.digest, SOLVER_VERSION)
        block = books.submit(new).job.id
        text, key = books.make_key("lab", ["worker"], "", None)
        with closing(Connection(url, text)) as connection, ThreadPoolExecutor(1) as threads:
            working = threads.submit(work, connection, draining, None)
            try:
                until(lambda: books.get(block).progress_fraction > 0.0 or working.done())
                books.revoke_key(key.id)
                until(working.done)
            finally:
                draining.set()
            with pytest.raises(Refused, match="asks for a key that is valid"):
                working.result()
        assert [one.outcome for one in books.attempts(block)] == [None]
    assert [line.message for line in caplog.records if line.levelname == "ERROR"] == []


def test_what_a_worker_spent_is_counted_when_it_asks_again(tmp_path: Path) -> None:
    with served(tmp_path) as (url, books):
        job = admit(SWING)
        books.submit(NewJob("simulate", job.job, job.digest, SOLVER_VERSION))
        with closing(Connection(url, None)) as connection:
            assert work(connection, threading.Event(), 0.5) == 1
        totals = books.census().totals
        assert totals[PUBLISHED] == 1
        assert totals[PUBLISHING] > 0.0
        odd = {"program": "0", "worker": "w", "version": "1", "processor": "p", "wait": 0.0}
        said = httpx.post(f"{url}/v1/worker/claims", json=odd | {"spent": {"other": 1.0}})
        assert said.status_code == 422
        assert books.census().totals == totals


def test_processes_end_with_the_one_that_began_them(tmp_path: Path) -> None:
    with served(tmp_path) as (url, books), subprocess.Popen([*WORKER, url]) as parent:
        try:
            until(lambda: len(books.workers()) == 2)
            children = [*descendants(parent.pid)]
        finally:
            parent.kill()
        assert len(children) == 2
        until(lambda: not any(is_alive(child) for child in children))


@pytest.mark.long
def test_processes_that_are_told_to_end_do_so_together(tmp_path: Path) -> None:
    with served(tmp_path) as (url, books):
        with subprocess.Popen([*WORKER, url], stdout=subprocess.PIPE, text=True) as parent:
            try:
                until(lambda: len(books.workers()) == 2)
            finally:
                parent.terminate()
            said, _ = parent.communicate()
        assert (parent.returncode, said) == (0, "computed 0 blocks\n")
