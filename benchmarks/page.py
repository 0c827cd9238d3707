"""The page in headless Chromium: time to the first frame, frames a second, bytes of each view.

``python -m benchmarks.page`` prints one table; it needs Chromium and playwright, as the tests of
the page do. ``--without-tests`` leaves out how long these take.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import httpx
from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks import in_browser
from benchmarks.chart_service import BETWEEN, JOB, SIDE, axes, ended
from jointplay.service.processes import running_service
from tests.page.browsing import chromium

ROOT = Path(__file__).resolve().parents[1]
PRESS = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}
SAMPLES = 10_000_000
JOBS = 10_000
FLAGS = ["--no-sandbox", "--enable-precise-memory-info"]


def finished(client: httpx.Client, job: dict[str, Any]) -> str:
    """Submit a job and return its id when it is finished."""
    shown = client.post("/v1/jobs", json=job).raise_for_status().json()
    while shown["finished"] is None:
        shown = client.get(f"/v1/jobs/{shown['id']}", params={"wait": 60}).json()
    return str(shown["id"])


def row(what: str, value: str) -> None:
    """Print a line of the table as soon as it is known."""
    print(f"| {what} | {value} |", flush=True)


def measure(browser: Browser, client: httpx.Client) -> None:
    """Print what a browser sees of a service."""
    url = str(client.base_url).rstrip("/")
    four = [finished(client, PRESS | {"label": f"{i}", "cache": False}) for i in range(4)]
    views = {
        "start": "",
        "new job": "#/new/seven-bar-press",
        "jobs": "#/jobs",
        "job": f"#/job/{four[0]}",
        "its accuracy": f"#/job/{four[0]}/accuracy",
        "its numbers": f"#/job/{four[0]}/numbers",
        "four compared": f"#/compare?jobs={','.join(four)}",
        "editor": "#/editor",
        "reference": "docs",
    }
    for name, place in views.items():
        first, answers, again, barriers = in_browser.view(browser, f"{url}/{place}")
        cost = f"{first:.0f} kB in {answers} answers, again {again:.0f} kB"
        row(f"{name}: bytes; axe", f"{cost}; {barriers} violations")
    cold, warm = in_browser.first_frame(browser, f"{url}/#/job/{four[0]}")
    row("first moving frame of a finished press", f"{warm:.0f} ms, at the first visit {cold:.0f}")
    page = in_browser.opened(browser)
    page.goto(f"{url}/#/compare?jobs={','.join(four)}")
    row("frames a second, four compared jobs", words(in_browser.playing(page)))
    many = PRESS | {"output_step": 2.0 / SAMPLES, "channels": ["acceleration"]}
    finest = finished(client, many | {"certificate": False})
    page.goto(f"{url}/#/job/{finest}?from=0.9&to=1.1&t=1")
    row(f"frames a second, panning {SAMPLES} samples", words(in_browser.panning(page)))
    measure_map(page, client)
    batch = client.post("/v1/batches", json={"jobs": [PENDULUM] * JOBS}).raise_for_status()
    client.post(f"{batch.headers['Location']}/cancel").raise_for_status()
    page.goto(f"{url}/#/jobs?scene=pendulum")
    frames, heap = in_browser.scrolling(page)
    row(f"frames a second, scrolling {JOBS} jobs", f"{frames:.0f}, {heap:.0f} MB of heap")


def measure_map(page: Page, client: httpx.Client) -> None:
    """Print how a map of a million points that are still computed is opened and moved."""
    submitted = client.post("/v1/jobs", json=JOB | axes(SIDE)).raise_for_status().json()["id"]
    while not ended(client, submitted):
        time.sleep(BETWEEN)
    page.goto(f"{client.base_url}#/job/{submitted}")
    painted, rates = in_browser.mapping(page)
    row(f"map of {SIDE} x {SIDE} points, painted", f"{painted:.2f} s")
    row("frames a second, moving and scaling it", words(rates))
    client.post(f"/v1/jobs/{submitted}/cancel").raise_for_status()


def words(rates: list[float]) -> str:
    """Tell the median and the best of some rates."""
    return f"{rates[len(rates) // 2]:.0f}, at best {rates[-1]:.0f}"


def tests() -> str:
    """Run the tests of the page and tell how long they take."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    ended = subprocess.run(
        [sys.executable, "-m", "pytest", "tests/page", "-q"], cwd=ROOT, capture_output=True
    )
    seconds, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    verdict = "passed" if ended.returncode == 0 else f"FAILED with code {ended.returncode}"
    return f"{verdict}, {seconds:.0f} s, {spent:.0f} s of processor"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--without-tests", action="store_true")
    options = parser.parse_args()
    row("measured", "value")
    print("|---|---|")
    before = os.getloadavg()[0]
    with (
        tempfile.TemporaryDirectory() as folder,
        running_service(Path(folder) / "data") as url,
        httpx.Client(base_url=url, trust_env=False, timeout=600) as client,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=chromium(), args=FLAGS)
        measure(browser, client)
        browser.close()
    loads = f"{before:.1f} before, {os.getloadavg()[0]:.1f} after"
    row(f"load of {os.cpu_count()} cores, last minute", loads)
    if not options.without_tests:
        row("tests/page", tests())


if __name__ == "__main__":
    main()
