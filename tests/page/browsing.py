"""Pages of a browser that complain about errors, and look for barriers with axe."""

import os
import re
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

AXE = Path(__file__).parent / "vendor" / "axe.min.js"
PATIENCE = 300_000  # ms: of a wait; a machine may be busy, or compile equations for the first time
_RULES = {"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]}


def chromium() -> str | None:
    """Return the path of Chromium, or None."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, names)), None)


def expect(shown: Any) -> Any:
    """Playwright's questions about a page, or a part of it, that wait for their answer.

    A page is never as a test wants it at once: what one sentence shows, another shows later.
    """
    from playwright import sync_api  # what needs it is skipped where it is not installed

    return sync_api.expect(shown)


def run_and_come_back(page: Any) -> None:
    """Run the job of a form, cancel it, and open the form with its numbers."""
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page).to_have_url(re.compile("#/job/"))
    page.get_by_role("button", name="Cancel").click()
    page.get_by_role("link", name="Run with changes").click()


UNFINISHED = ("422", "404")
"""Complaints about estimates while fields are empty, and about figures of what was cancelled."""

BUSY = "status of 503 (Service Unavailable)", "/v1/estimates"
"""Parts of a complaint of a browser about an estimate that a busy machine had no time for: the page
asks again."""


class Browsing:
    """Opens pages of one browser.

    Parameters
    ----------
    browser
        Playwright's browser.
    """

    def __init__(self, browser: Any) -> None:
        self._browser = browser

    @contextmanager
    def page(
        self,
        url: str,
        *,
        width: int = 1280,
        dark: bool = False,
        expected: tuple[str, ...] = (),
        still: bool = False,
    ) -> Iterator[Any]:
        """Open an address; afterwards nothing may have been complained about in the console.

        Parameters
        ----------
        expected
            Parts of complaints that belong to the test.
        still
            Whether the reader asks for little motion.
        """
        context = self._browser.new_context(
            viewport={"width": width, "height": 900},
            color_scheme="dark" if dark else "light",
            reduced_motion="reduce" if still else "no-preference",
        )
        context.set_default_timeout(PATIENCE)
        page = context.new_page()
        complaints: list[str] = []
        page.on("pageerror", lambda error: complaints.append(f"{error} {error.stack}"))
        page.on("console", lambda said: complaints.append(f"{said.text} {said.location}"))
        page.on("request", lambda asked: self._stay_here(asked.url, url, complaints))
        page.goto(url)
        try:
            yield page
        finally:
            context.close()
        left = [one for one in complaints if not any(part in one for part in expected)]
        left = [one for one in left if not all(part in one for part in BUSY)]
        assert not left, left

    @staticmethod
    def _stay_here(asked: str, url: str, complaints: list[str]) -> None:
        origin = "/".join(url.split("/")[:3])
        if not asked.startswith((origin, "blob:", "data:")):
            complaints.append(f"{asked} was loaded from elsewhere")


def slowly(page: Any, addresses: str) -> None:
    """Have answers come slowly and one after the other, as over a poor link."""

    def answer(route: Any) -> None:
        time.sleep(0.2)
        route.continue_()

    page.route(addresses, answer)


def barriers(page: Any) -> list[str]:
    """Return what keeps readers of any kind from a page, as short sentences.

    That is what axe finds wrong, and what is wider than the window; both as soon as two looks in
    a row find the same, since a page may be changing while it is looked at.
    """
    page.evaluate(AXE.read_text())  # the page's own policy lets no script in
    before, found = None, _found(page)
    while found and found != before:
        before, found = found, _found(page)
    return found


def barriers_everywhere(page: Any) -> dict[str, list[str]]:
    """Return the barriers of a page by width and colours, of those that have any."""
    found = {}
    for width in (360, 1280):
        for colours in ("light", "dark"):
            page.set_viewport_size({"width": width, "height": 900})
            page.emulate_media(color_scheme=colours)
            found[f"{width} px, {colours}"] = barriers(page)
    return {where: some for where, some in found.items() if some}


def _found(page: Any) -> list[str]:
    found = page.evaluate("rules => axe.run(document, rules)", _RULES)
    wide, width = page.evaluate("document.documentElement.scrollWidth"), page.viewport_size["width"]
    return [
        f"{one['id']}: {node['target']} {node.get('failureSummary', '')}"
        for one in found["violations"]
        for node in one["nodes"]
    ] + ([f"{wide} px wide where {width} px are"] if wide > width else [])
