"""A service that can record nothing says so, and when to come again; it records nothing then."""

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import httpx
import pytest
from sqlalchemy import Engine, event

from jointplay.service.app import create_app
from jointplay.storage.catalogue import connections
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
SUBMISSIONS = pytest.mark.parametrize(
    ("path", "document"),
    [("/v1/jobs", JOB), ("/v1/batches", {"jobs": [JOB, JOB]})],
    ids=["a job", "a batch"],
)


@pytest.fixture
def held_catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[httpx.Client]:
    """A service that is less patient than others, and whose catalogue another program holds."""
    with (
        serving(create_app(Settings(data=tmp_path))) as url,
        closing(sqlite3.connect(tmp_path / "catalogue.sqlite", isolation_level=None)) as other,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as client,
    ):
        assert client.get("/healthz").is_success  # it has started, and written what it had to
        monkeypatch.setattr(connections, "_PATIENCE", 0.1)  # a start may take longer
        other.execute("BEGIN EXCLUSIVE")
        yield client


@SUBMISSIONS
def test_a_catalogue_that_is_held_refuses_what_it_cannot_record(
    held_catalogue: httpx.Client,
    caplog: pytest.LogCaptureFixture,
    path: str,
    document: object,
) -> None:
    key = {"Idempotency-Key": "once"}
    answer = held_catalogue.post(path, json=document, headers=key)
    assert (answer.status_code, answer.headers["Retry-After"]) == (503, "5")
    assert f"POST {path} was answered with 503: The catalogue is held" in caplog.text
    assert "Traceback" not in caplog.text
    problem = answer.json()
    assert problem["type"].endswith("unavailable")
    assert problem["detail"] == "The catalogue is held by another program; nothing was recorded."
    assert held_catalogue.get("/v1/jobs").json()["jobs"] == []


def test_a_catalogue_whose_disk_is_full_says_so_and_records_nothing(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    catalogue.close()

    @event.listens_for(Engine, "connect")
    def grow_no_further(connection: sqlite3.Connection, _: object) -> None:
        connection.execute("PRAGMA max_page_count=1")  # as large as it is

    try:
        with (
            serving(create_app(settings)) as url,
            httpx.Client(base_url=url, trust_env=False, timeout=60) as client,
        ):
            answer = client.post("/v1/batches", json={"jobs": [JOB] * 300})
            assert (answer.status_code, answer.headers["Retry-After"]) == (507, "5")
            problem = answer.json()
            assert problem["type"].endswith("disk-full")
            assert problem["detail"].endswith("no room left on its disk; nothing was recorded.")
            assert client.get("/v1/jobs").json()["jobs"] == []
    finally:
        event.remove(Engine, "connect", grow_no_further)


@SUBMISSIONS
def test_a_disk_without_room_takes_no_further_work(
    tmp_path: Path, path: str, document: object
) -> None:
    # running jobs may still take what is beyond the reserve, three tenths
    full = Settings(data=tmp_path, reserve=int(0.7 * shutil.disk_usage(tmp_path).free))
    assert full.room() > 0
    with (
        serving(create_app(full)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as client,
    ):
        answer = client.post(path, json=document)
        assert (answer.status_code, answer.headers["Retry-After"]) == (507, "30")
        assert answer.json()["type"].endswith("disk-full")
        assert client.get("/v1/jobs").json()["jobs"] == []
