"""A real browser and a real service, shared by all tests of the page."""

import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from jointplay.service.processes import running_service
from tests.page.browsing import PATIENCE, Browsing, chromium
from tests.service_in_thread import (
    application,
    catalogue,
    fresh_service,
    http,
    service_url,
    settings,
)
from tests.worker_by_hand import finished_sweep, worker

ROOT = Path(__file__).resolve().parents[2]
ARTIFACTS = ROOT / "tests" / "artifacts"
MINUTES = 20
"""For which the end of a short job is waited for, however busy the machine is."""
INSTALLING = ROOT / "build" / "chromium.installing"


@pytest.fixture(scope="session")
def browsing() -> Iterator[Browsing]:
    """Headless Chromium; what needs it is skipped, by name, where there is none."""
    reason = "no Chromium: apt-get install chromium, and pip install playwright"
    sync_api = pytest.importorskip("playwright.sync_api", reason=reason)
    # `make test` begins it, and gives up after 260 s; one that was killed leaves its mark
    give_up = time.monotonic() + 300
    while INSTALLING.exists() and time.monotonic() < give_up:
        time.sleep(0.5)  # apt-get has no progress that could be waited for
    found = chromium()
    if found is None:
        pytest.skip(reason)
    sync_api.expect.set_options(timeout=PATIENCE)
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found, args=["--no-sandbox"], timeout=PATIENCE
        )
        yield Browsing(browser)
        browser.close()


@pytest.fixture(scope="session")
def url(browsing: Browsing, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A service with a worker."""
    with running_service(tmp_path_factory.mktemp("page") / "data") as url:
        yield url


@pytest.fixture(scope="session")
def press(url: str) -> str:
    """A finished run of the press: the id of its job."""
    job = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.05}
    return submitted(url, job | {"label": "a press to watch"})


def submitted(url: str, job: dict[str, object]) -> str:
    """Submit a job and wait for its end."""
    with httpx.Client(base_url=url, trust_env=False, timeout=120) as client:
        found = client.post("/v1/jobs", json=job).raise_for_status().json()
        for _ in range(MINUTES):
            if found["finished"] is not None:
                break
            found = client.get(f"/v1/jobs/{found['id']}", params={"wait": 60}).json()
        assert found["state"] == "succeeded", found
        return str(found["id"])


@contextmanager
def running(url: str, job: dict[str, object]) -> Iterator[str]:
    """Submit a job, and cancel it afterwards."""
    with httpx.Client(base_url=url, trust_env=False, timeout=120) as client:
        made = str(client.post("/v1/jobs", json=job).raise_for_status().json()["id"])
        yield made
        client.post(f"/v1/jobs/{made}/cancel").raise_for_status()


@pytest.fixture(scope="session")
def artifacts() -> Path:
    """The folder for screenshots, which version control ignores."""
    shutil.rmtree(ARTIFACTS, ignore_errors=True)
    ARTIFACTS.mkdir()
    return ARTIFACTS
