"""The page in headless Chromium: time to the first frame, frames a second, bytes of each view.

``python -m benchmarks.page``; needs Chromium and playwright, as the tests of the page do.
"""

import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
from playwright.sync_api import Page, sync_playwright

from jointplay.service.processes import running_service
from tests.page.browsing import chromium

PRESS = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}
PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}
SAMPLES = 10_000_000
JOBS = 10_000
SECONDS = 4.0
FLAGS = ["--no-sandbox", "--enable-precise-memory-info"]
_FRAME = "Number(document.querySelector('.stage canvas')?.dataset.frames ?? 0)"
_PAN = """async seconds => {
  const over = document.querySelector('.u-over');
  const end = performance.now() + 1000 * seconds;
  let frames = 0;
  for (let sign = 1; performance.now() < end; frames++) {
    if (frames % 60 === 0) sign = -sign;
    over.dispatchEvent(new WheelEvent('wheel', {deltaX: 8 * sign, bubbles: true}));
    await new Promise(requestAnimationFrame);
  }
  return frames / seconds;
}"""
_PLAY = """async seconds => {
  const before = FRAME;
  await new Promise(resolve => setTimeout(resolve, 1000 * seconds));
  return (FRAME - before) / seconds;
}""".replace("FRAME", _FRAME)

_SCROLL = """async () => {
  const list = document.querySelector('.rows');
  const began = performance.now();
  let frames = 0;
  for (let end = false; !end; frames++) {
    list.scrollTop += 400;
    await new Promise(requestAnimationFrame);
    end = list.scrollTop + list.clientHeight >= list.scrollHeight - 1
      && !document.querySelector('h1 + span').textContent.includes('+');
  }
  const seconds = (performance.now() - began) / 1000;
  return [frames / seconds, performance.memory.usedJSHeapSize / 1e6];
}"""


def finished(client: httpx.Client, **fields: Any) -> str:
    """Submit a press and return its id when it is finished."""
    job = client.post("/v1/jobs", json=PRESS | fields).raise_for_status().json()
    while job["finished"] is None:
        job = client.get(f"/v1/jobs/{job['id']}", params={"wait": 60}).json()
    return str(job["id"])


@contextmanager
def counted(page: Page) -> Iterator[list[int]]:
    """Count the bytes of the bodies that a page receives."""
    sizes: list[int] = []
    page.on("requestfinished", lambda asked: sizes.append(asked.sizes()["responseBodySize"]))
    yield sizes


def main() -> None:
    """Measure, and print a line for each number."""
    with (
        tempfile.TemporaryDirectory() as folder,
        running_service(Path(folder) / "data") as url,
        httpx.Client(base_url=url, trust_env=False, timeout=600) as client,
        sync_playwright() as playwright,
    ):
        four = [finished(client, label=f"{i}", cache=False) for i in range(4)]
        many = finished(
            client, output_step=2.0 / SAMPLES, channels=["acceleration"], certificate=False
        )
        browser = playwright.chromium.launch(executable_path=chromium(), args=FLAGS)
        views = {
            "start": "",
            "new job": "#/new/seven-bar-press",
            "job": f"#/job/{four[0]}",
            "jobs": "#/jobs",
            "editor": "#/editor",
        }
        for name, place in views.items():
            page = browser.new_page()
            with counted(page) as sizes:
                page.goto(f"{url}/{place}", wait_until="networkidle" if name == "start" else "load")
                page.wait_for_timeout(3000)
            print(f"{name}: {sum(sizes) / 1000:.0f} kB in {len(sizes)} answers")
            page.close()
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        for _ in range(2):  # the second is warm
            page.goto("about:blank")
            began = time.monotonic()
            page.goto(f"{url}/#/job/{four[0]}", wait_until="commit")
            page.wait_for_function(f"() => {_FRAME} > 1")
            first = time.monotonic() - began
        print(f"first moving frame of a finished press: {1000 * first:.0f} ms")
        page.goto(f"{url}/#/compare?jobs={','.join(four)}")
        page.wait_for_function(f"() => {_FRAME} > 1")
        print(f"4 compared jobs: {page.evaluate(_PLAY, SECONDS):.0f} frames/s")
        page.goto(f"{url}/#/job/{many}?from=0.9&to=1.1&t=1")
        page.locator(".uplot").first.wait_for()
        print(f"panning {SAMPLES} samples: {page.evaluate(_PAN, SECONDS):.0f} frames/s")
        batch = client.post("/v1/batches", json={"jobs": [PENDULUM] * JOBS}).raise_for_status()
        client.post(f"{batch.headers['Location']}/cancel").raise_for_status()
        page.goto(f"{url}/#/jobs?scene=pendulum")
        page.locator(".row").first.wait_for()
        frames, heap = page.evaluate(_SCROLL)
        print(f"scrolling through {JOBS} jobs: {frames:.0f} frames/s, {heap:.0f} MB of heap")
        browser.close()


if __name__ == "__main__":
    main()
