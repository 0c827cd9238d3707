"""Workers hold their blocks, and health is told, while other requests have all their threads."""

import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from jointplay.records.table_files import csv
from jointplay.service.fair_semaphore import EXPORTED_AT_ONCE, LISTED_AT_ONCE
from jointplay.service.owners import OF_ONE, UNTIL_ANSWERED, Shares
from jointplay.service.problems import RequestRefused
from jointplay.service.workers import attempts
from jointplay.storage.catalogue.records import JobPage
from tests.worker_by_hand import Worker

ASKED = 60  # more than there are threads


class Held:
    """A function that does not return before it may."""

    def __init__(self, found: Any) -> None:
        self.begun, self.may_end = threading.Semaphore(0), threading.Event()
        self._found = found

    def __call__(self, *_: Any, **__: Any) -> Any:
        self.begun.release()
        self.may_end.wait(60.0)
        return self._found


@contextmanager
def asked_often(held: Held, url: str, most: int, **headers: str) -> Iterator[None]:
    """Ask for something so often that `most` threads are held; every answer must be right."""
    with ThreadPoolExecutor(ASKED) as pool:
        get = [
            pool.submit(httpx.get, url, timeout=90, trust_env=False, headers=headers)
            for _ in range(ASKED)
        ]
        try:
            for _ in range(most):
                assert held.begun.acquire(timeout=60.0)
            yield
        finally:
            held.may_end.set()
    assert {one.result().status_code for one in get} == {200}


def test_words_of_workers_and_health_have_threads_of_their_own(
    application: FastAPI,
    http: httpx.Client,
    service_url: str,
    worker: Worker,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Whatever else took long kept heartbeats waiting until leases ran out."""
    claim = worker.start(worker.submit())
    address = f"/v1/worker/blocks/{claim.block.id}/{claim.block.attempt}"
    progress = {"time": 0.1, "fraction": 0.1}
    point = {"watermark": 1, "checkpoint": "block0-a1", "progress": progress}
    held = Held(())
    monkeypatch.setattr(application.state.catalogue, "workers_at_work", held)
    with asked_often(held, f"{service_url}/v1/workers", 40):
        for word, said in {"heartbeat": None, "progress": progress, "checkpoint": point}.items():
            answer = http.post(f"{address}/{word}", json=said, timeout=20.0)
            assert answer.json() == {"verdict": "continue"}
        assert http.post(f"{address}/cut-off", timeout=20.0).status_code == 204
        assert http.get("/readyz", timeout=20.0).status_code == 200


def test_many_files_of_one_leave_threads_for_others(
    http: httpx.Client, service_url: str, finished_job: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = Held(b"a table")
    monkeypatch.setattr(csv, "encode", held)
    url = f"{service_url}/v1/jobs/{finished_job}/history"
    with asked_often(held, url, EXPORTED_AT_ONCE, accept=csv.MEDIA_TYPE):
        assert not held.begun.acquire(timeout=1.0)  # no third one
        assert http.get("/v1/jobs", timeout=20.0).status_code == 200


def test_many_pages_of_jobs_leave_threads_for_others(
    application: FastAPI, http: httpx.Client, service_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Documents of jobs have megabytes: 40 pages at once took all that there was of one core."""
    held = Held(JobPage((), None))
    monkeypatch.setattr(application.state.catalogue, "jobs", held)
    with asked_often(held, f"{service_url}/v1/jobs", LISTED_AT_ONCE):
        assert not held.begun.acquire(timeout=1.0)  # no fifth one
        assert http.get("/v1/workers", timeout=20.0).status_code == 200


def test_an_owner_has_no_more_words_of_workers_than_other_requests_at_once() -> None:
    """One key could take all that the others' workers need."""
    shares = Shares()
    path = attempts.router.prefix.format(block="b", attempt=1)
    with ExitStack() as held:
        for word in ("heartbeat", "checkpoint"):
            scope = {"path": f"{path}/{word}", UNTIL_ANSWERED: held}
            for _ in range(OF_ONE // 2):
                shares.enter(scope, "ada")
        with pytest.raises(RequestRefused):
            shares.enter(scope, "ada")
        shares.enter(scope, "bob")
        shares.enter({"path": "/v1/jobs", UNTIL_ANSWERED: held}, "ada")
    shares.enter({"path": f"{path}/progress", UNTIL_ANSWERED: held}, "ada")
