"""Films and pictures to keep, joints shown magnified, and mechanisms that are dragged."""

import json
import math

import pytest
from PIL import Image

from tests.page.conftest import submitted
from tests.page.test_watching import MOVED
from tests.solver import cams, sliders

PIXELS = """([label, colour]) => {
  const canvas = document.querySelector(`canvas[aria-label="${label}"]`);
  if (!canvas?.width) return [0, 0, 0];
  const { width, height } = canvas;
  const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, width, height);
  const wanted = getComputedStyle(document.documentElement).getPropertyValue(`--${colour}`);
  const parts = [1, 3, 5].map((at) => parseInt(wanted.trim().slice(at, at + 2), 16));
  let [count, right, down] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (parts.some((part, k) => Math.abs(part - data[i + k]) > 3)) continue;
    [count, right, down] = [count + 1, right + (i / 4) % width, down + Math.floor(i / 4 / width)];
  }
  return [count, right / count, down / count];
}"""
"""Number of pixels of a colour on a canvas, and their centre."""
DRAWN = f"""asked => {{
  const found = ({PIXELS})(asked);
  return found[0] > asked[2] && found;
}}"""
REDRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
EDITED = "The mechanism as the text describes it"


def drawn(page, label, colour, least):
    """Number of pixels of a colour on a canvas, and their centre, once there are so many."""
    return page.wait_for_function(DRAWN, arg=[label, colour, least]).json_value()


def test_a_gif_shows_the_frames_from_the_time_that_is_shown(browsing, url, press):
    with browsing.page(f"{url}/#/job/{press}?t=0.046", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        speed = float(page.get_by_label("Speed").input_value())
        with page.expect_download() as download:
            page.get_by_role("button", name="GIF").click()
        assert download.value.suggested_filename == "seven-bar-press.gif"
        with Image.open(download.value.path()) as film:
            assert film.n_frames == pytest.approx(1.0 + 0.004 / (0.05 * speed), abs=1.0)
            assert film.info["duration"] == 50
            assert film.width <= 640
            first = film.convert("RGB").tobytes()
            film.seek(film.n_frames - 1)
            assert film.convert("RGB").tobytes() != first
        page.get_by_text("t = 46 ms").wait_for()


def test_a_film_is_recorded_where_the_browser_can(browsing, url, press):
    with browsing.page(f"{url}/#/job/{press}?t=0.04", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        with page.expect_download() as download:
            page.get_by_role("button", name="Film").click()
        content = download.value.path().read_bytes()
        if download.value.suggested_filename.endswith(".webm"):
            assert content.startswith(b"\x1a\x45\xdf\xa3")
        else:
            assert content[4:8] == b"ftyp"
        reader = pytest.importorskip(
            "imageio_ffmpeg", reason="no ffmpeg: pip install imageio-ffmpeg"
        )
        frames, _ = reader.count_frames_and_secs(download.value.path())
        assert frames > 1


def test_a_slider_and_a_cam_are_shown(browsing, url, artifacts):
    slides = submitted(url, {"kind": "simulate", "scene": sliders.swinging(), "duration": 0.05})
    with browsing.page(f"{url}/#/job/{slides}?t=0.04", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.get_by_text("gap ×19").wait_for()
        drawn(page, "Slider of joint guide in its guide", "tint-0", 500)
        page.screenshot(path=artifacts / "slider.png")
    with browsing.page(f"{url}/#/editor") as page:
        joint = cams.follower("flat", cams.CIRCLE, lash=1e-4)
        page.get_by_label("Scene document").fill(json.dumps(cams.valve(joint)))
        page.get_by_text("Degrees of freedom: 1").wait_for()
        drawn(page, EDITED, "ground", 2000)
        page.screenshot(path=artifacts / "cam.png")


def test_a_mechanism_in_the_editor_is_dragged(browsing, url):
    with browsing.page(f"{url}/#/editor") as page:
        page.get_by_text("of one core").wait_for()  # the last that comes, and moves the drawing
        corner = page.get_by_label(EDITED).bounding_box()

        def pin():
            """Place of the only joint with play, at the end of the crank."""
            page.evaluate(REDRAWN)  # the pointer's moves are told to the page once a frame
            _, right, down = drawn(page, EDITED, "play", 20)
            return corner["x"] + right, corner["y"] + down

        before = pin()
        wanted = before[0] - 60.0, before[1] + 20.0
        page.mouse.move(*before)
        page.mouse.down()
        for share in (0.25, 0.5, 0.75, 1.0):
            page.mouse.move(*(a + share * (b - a) for a, b in zip(before, wanted, strict=True)))
        page.mouse.up()
        after = pin()
        assert math.dist(after, wanted) < math.dist(before, wanted) - 20.0  # pixels
        page.mouse.move(*before)  # let go
        assert pin() == after
