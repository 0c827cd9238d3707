"""Pictures of the page that the README shows: ``python -m tests.page.readme_pictures``.

Needs Chromium and playwright, as the tests of the page do, and a minute.
"""

import tempfile
from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Page, sync_playwright

from jointplay.service.processes import running_service
from tests.page.browsing import PATIENCE, chromium
from tests.page.conftest import submitted

DOCS = Path(__file__).parents[2] / "docs"
PRESS: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 0.2,
}
OSCILLATOR: dict[str, Any] = {
    "kind": "bifurcation",
    "scene": {"preset": "impact-oscillator", "parameters": {"gap": 0.0}},
    "parameter": "speed",
    "values": {"from": 46.0, "to": 74.0, "count": 280},
    "settle": 60,
    "record": 40,
    "indicators": "all",
    "continuation": "both",
}


def take(page: Page, name: str) -> None:
    """Keep what the window shows."""
    picture = Image.open(BytesIO(page.screenshot())).convert("RGB")  # it is opaque
    picture.save(DOCS / f"{name}.png", optimize=True)


def main() -> None:
    """Run the jobs that are shown, and take the pictures."""
    with (
        tempfile.TemporaryDirectory() as folder,
        running_service(Path(folder) / "data") as url,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_page(
            viewport={"width": 1280, "height": 1000}, reduced_motion="reduce", color_scheme="light"
        )
        page.set_default_timeout(PATIENCE)
        page.goto(f"{url}/#/job/{submitted(url, PRESS)}?t=0.0287")
        page.locator(".uplot").nth(4).wait_for()
        page.get_by_text("a contact begins").wait_for()
        page.get_by_text("other tolerances take other paths").wait_for()
        take(page, "page_watch")
        page.goto(f"{url}/#/job/{submitted(url, OSCILLATOR)}")
        page.locator("canvas[data-done]").wait_for()
        take(page, "page_diagram")
        browser.close()


if __name__ == "__main__":
    main()
