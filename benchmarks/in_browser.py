"""Numbers that a reader would notice: frames while something moves, bytes until it is there."""

import statistics
import time
from collections.abc import Callable
from typing import Any, Final

from playwright.sync_api import Browser, Page, Request

from tests.page.browsing import barriers

PATIENCE: Final = 600_000
"""Milliseconds for one thing on a machine that has much else to do."""
_SECONDS: Final = 4.0
_STILL: Final = 2.0
"""Seconds without a new request after which a view is taken to be there."""
FRAME: Final = "Number(document.querySelector('.stage canvas')?.dataset.frames ?? 0)"
_PAN: Final = """async seconds => {
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
_PLAY: Final = """async seconds => {
  const [before, began] = [FRAME, performance.now()];
  await new Promise(resolve => setTimeout(resolve, 1000 * seconds));
  return 1000 * (FRAME - before) / (performance.now() - began);
}""".replace("FRAME", FRAME)
MAP: Final = "canvas[aria-label$='arrows move, plus and minus scale']"
_MOVE: Final = """async ([map, seconds]) => {
  const canvas = document.querySelector(map);
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const place = { clientX: left + 0.6 * width, clientY: top + 0.4 * height, bubbles: true };
  const [before, begun] = [Number(canvas.dataset.frames), performance.now()];
  for (let i = 0; performance.now() < begun + 1000 * seconds; i++) {
    const [deltaY, key] = [i % 40 < 20 ? -1 : 1, i % 80 < 40 ? 'ArrowLeft' : 'ArrowRight'];
    canvas.dispatchEvent(i % 2
      ? new WheelEvent('wheel', { ...place, deltaY, cancelable: true })
      : new KeyboardEvent('keydown', { key }));
    await new Promise(requestAnimationFrame);
  }
  return (1000 * (Number(canvas.dataset.frames) - before)) / (performance.now() - begun);
}"""
_SCROLL: Final = """async () => {
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


def opened(browser: Browser, *, still: bool = False) -> Page:
    """Open an empty page of a reader who has never been here."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 900},
        reduced_motion="reduce" if still else "no-preference",
    )
    context.set_default_timeout(PATIENCE)
    return context.new_page()


def view(browser: Browser, address: str) -> tuple[float, int, float, int]:
    """Return a view's kilobytes and answers, those of a second visit, and axe's violations.

    Nothing moves by itself in it: a motion that plays fetches more as it goes on. What is asked
    again and again, as the list of jobs is, counts once.
    """
    page = opened(browser, still=True)
    sizes: dict[str, int] = {}

    def note(asked: Request) -> None:
        sizes.setdefault(asked.url, _received(asked))

    page.on("requestfinished", note)
    visits = []
    for _ in range(2):
        sizes.clear()
        page.goto("about:blank")
        page.goto(address, wait_until="load")
        _until_still(page, sizes)
        visits.append((sum(sizes.values()) / 1000.0, len(sizes)))
    found = len(barriers(page))
    page.context.close()
    return *visits[0], visits[1][0], found


def first_frame(browser: Browser, address: str, visits: int = 7) -> tuple[float, float]:
    """Return the milliseconds until the mechanism moves: of a first visit, and of later ones."""
    page = opened(browser)
    found = []
    for _ in range(1 + visits):
        page.goto("about:blank")
        began = time.monotonic()
        page.goto(address, wait_until="commit")
        page.wait_for_function(f"() => {FRAME} > 1")
        found.append(1000.0 * (time.monotonic() - began))
    page.context.close()
    return found[0], statistics.median(found[1:])


def playing(page: Page) -> list[float]:
    """Return frames a second of a mechanism that moves."""
    page.wait_for_function(f"() => {FRAME} > 1")
    return _three_times(lambda: page.evaluate(_PLAY, _SECONDS))


def panning(page: Page) -> list[float]:
    """Return frames a second of a history that is panned."""
    page.locator(".uplot").first.wait_for()
    return _three_times(lambda: page.evaluate(_PAN, _SECONDS))


def mapping(page: Page) -> tuple[float, list[float]]:
    """Return seconds until a map is painted, and frames a second while it is moved and scaled."""
    begun = time.monotonic()
    page.wait_for_function(f"() => document.querySelector(\"{MAP}\")?.dataset.waiting === '0'")
    painted = time.monotonic() - begun
    return painted, _three_times(lambda: page.evaluate(_MOVE, [MAP, _SECONDS]))


def scrolling(page: Page) -> tuple[float, float]:
    """Return frames a second while a list of jobs is scrolled to its end, and megabytes then."""
    page.locator(".row").first.wait_for()
    frames, heap = page.evaluate(_SCROLL)
    return frames, heap


def _received(asked: Request) -> int:
    """Return the bytes of an answer's body on the way; none of what the browser had kept.

    Of that Playwright subtracts the headers from nothing.
    """
    return max(int(asked.sizes()["responseBodySize"]), 0)


def _three_times(measure: Callable[[], Any]) -> list[float]:
    return sorted(float(measure()) for _ in range(3))


def _until_still(page: Page, sizes: dict[str, int]) -> None:
    """Wait until nothing new has come for a while."""
    seen, since = -1, time.monotonic()
    while time.monotonic() - since < _STILL:
        page.wait_for_timeout(100)
        if len(sizes) != seen:
            seen, since = len(sizes), time.monotonic()
