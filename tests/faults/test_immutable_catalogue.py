"""A catalogue none of whose files can be written: problems with 503, and all goes on afterwards."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import which

import httpx
import pytest
from jobs import IMPATIENT, api_of, catalogue_of, ended

from jointplay.service.processes import running_service
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE, is_alive, until

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}


@contextmanager
def immutable(data: Path) -> Iterator[None]:
    """Let nobody write the catalogue while the block runs, or skip where that cannot be done."""
    files = [str(path) for path in sorted(data.glob("catalogue.sqlite*"))]
    assert len(files) == 3
    try:
        found = subprocess.run(["chattr", "+i", *files], check=False, capture_output=True)
        if found.returncode:
            pytest.skip(f"no file can be made immutable here: {found.stderr.decode()}")
        yield
    finally:
        subprocess.run(["chattr", "-i", *files], check=False, capture_output=True)


def asking_anew(url: str) -> httpx.Client:
    """Return a client that keeps no connections, which end with the process."""
    limits = httpx.Limits(max_keepalive_connections=0)
    return httpx.Client(base_url=url, trust_env=False, timeout=PATIENCE, limits=limits)


def refused(http: httpx.Client) -> None:
    """Have everything that needs the catalogue refused, and nothing hang."""
    for _ in range(5):
        assert http.get("/healthz").status_code == 200
        assert http.get("/readyz").status_code == 503
        answer = http.post("/v1/jobs", json=SWING)
        assert answer.status_code == 503
        assert answer.json()["type"] == "/problems/unavailable"
        assert answer.headers["Retry-After"]


@pytest.mark.skipif(which("chattr") is None, reason="no chattr")
def test_a_catalogue_that_cannot_be_written_at_all_is_unavailable(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data")
    with (
        running_service(settings.data, environment=IMPATIENT) as url,
        catalogue_of(settings) as catalogue,
        httpx.Client(base_url=url, trust_env=False, timeout=PATIENCE) as http,
    ):
        first = http.post("/v1/jobs", json=SWING).json()["id"]
        with immutable(settings.data):
            refused(http)
        until(lambda: http.get("/readyz").status_code == 200)
        second = http.post("/v1/jobs", json=SWING).json()["id"]
        for job in (first, second):
            assert ended(catalogue, job).state is JobState.succeeded


@pytest.mark.skipif(which("chattr") is None, reason="no chattr")
def test_an_api_that_starts_meanwhile_answers_too(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data")
    with (
        running_service(settings.data, workers=0, environment=IMPATIENT) as url,
        asking_anew(url) as http,
    ):
        assert http.post("/v1/jobs", json=SWING).status_code == 202
        with immutable(settings.data):
            for pid in api_of(settings.data):
                subprocess.run(["kill", "-9", str(pid)], check=True)
                until(lambda pid=pid: not is_alive(pid))
            refused(http)
        until(lambda: http.get("/readyz").status_code == 200)
        assert http.post("/v1/jobs", json=SWING).status_code == 202
