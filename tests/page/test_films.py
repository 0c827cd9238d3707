"""Films and pictures to keep, joints shown magnified, and mechanisms that are dragged."""

import json
import math
import struct
import subprocess

import httpx
import numpy as np
import pytest
from PIL import Image

from tests.page.conftest import submitted
from tests.page.test_own_mechanism import paste
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
JOURNAL = "#9cc9e8"
"""Colour of journals, and of what slides or follows."""
FORCE = "#b3123f"
"""Colour of the arrows of forces."""
DRAWN = f"""asked => {{
  const found = ({PIXELS})(asked);
  return found[0] > asked[2] && found;
}}"""
REDRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
ANSWERED = """label =>
  document.querySelector(`canvas[aria-label="${label}"]`).ariaBusy !== "true"
"""
"""A mechanism is drawn as the pointer left it."""
EDITED = "The mechanism as the text describes it"


def drawn(page, label, colour, least):
    """Number of pixels of a colour on a canvas, and their centre, once there are so many."""
    return page.wait_for_function(DRAWN, arg=[label, colour, least]).json_value()


@pytest.fixture
def ready(browsing, url, press):
    """The press of a finished run at 45 ms, between two impacts, a hundred times slower."""
    with browsing.page(f"{url}/#/job/{press}?t=0.045", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.get_by_label("Speed").select_option("0.01")
        page.locator(".uplot").nth(4).wait_for()  # impacts are known, too
        page.get_by_text("penetration ×46").first.wait_for()
        yield page


def saved(page, form):
    with page.expect_download() as download:
        page.get_by_role("button", name=form, exact=True).click()
    assert download.value.suggested_filename == f"seven-bar-press.{form.lower()}"
    return download.value.path()


def near(picture, colour):
    """Pixels of a picture that have nearly a colour."""
    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    # colours of a GIF are among 128, those of videos are coded coarsely
    return np.abs(np.asarray(picture.convert("RGB"), int) - wanted).max(axis=2) < 12


def test_a_gif_shows_the_stretch_that_is_asked_with_the_magnified_joints(ready):
    mechanism = ready.locator(".stage canvas").bounding_box()
    path = saved(ready, "GIF")
    with Image.open(path) as film:
        wide = min(mechanism["width"], 640.0)
        assert film.width == pytest.approx(wide, abs=1.0)  # whole pixels
        assert film.n_frames == 10  # 5 ms until the end are 0.5 s of film
        pictures, delays, arrows = [], [], []
        for frame in range(film.n_frames):
            film.seek(frame)
            delays.append(film.info["duration"])
            pictures.append(near(film, JOURNAL))
            arrows.append(near(film, FORCE).sum())
    assert sum(delays) == 500
    assert arrows[0] == 0  # nothing touches yet
    assert any(arrows)  # then a short arrow has its colour, which the first frame lacks
    first_row = round(wide / mechanism["width"] * mechanism["height"])
    journals = [picture[first_row:] for picture in pictures]
    assert journals[0].sum() > 5000  # two discs whose radius is a sixth of a cell of 300 pixels
    assert (journals[0] != journals[-1]).sum() > 200  # and they move
    ready.get_by_text("t = 45 ms").wait_for()


def test_a_moment_is_saved_with_the_magnified_joints(ready):
    _, mechanism, *insets = saved(ready, "SVG").read_text().split("<svg")
    assert "<title>a press to watch at 0.045 s</title>" in mechanism
    assert ">t = 45 ms<" in mechanism
    assert len(insets) == 2
    for inset in insets:
        assert JOURNAL in inset
        assert ">gap ×3.8, penetration ×" in inset


@pytest.mark.parametrize("form", [pytest.param("MP4", marks=pytest.mark.long), "WebM"])
def test_a_video_lasts_from_impact_to_impact(ready, url, press, form, tmp_path):
    job = httpx.get(f"{url}/v1/jobs/{press}", trust_env=False).json()
    found = httpx.get(f"{url}{job['links']['impacts']}", trust_env=False).json()["impacts"]
    onsets = np.sort([impact["onset"] for impact in found])
    before, after = onsets[onsets <= 0.045].max(), onsets[onsets > 0.045].min()
    ready.get_by_label("Length of the film").select_option("impact")
    path = saved(ready, form)
    asked = 100.0 * (after - before)
    assert lasting(path.read_bytes(), form) == pytest.approx(asked, abs=5.1e-4)  # whole ms
    reason = "no ffmpeg: pip install imageio-ffmpeg"
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason=reason).get_ffmpeg_exe()
    each = ["-fps_mode", "passthrough", tmp_path / "%03d.png"]
    subprocess.run([ffmpeg, "-loglevel", "error", "-i", path, *each], check=True)
    pictures = sorted(tmp_path.iterdir())
    assert len(pictures) == round(30 * asked)
    mechanism = ready.locator(".stage canvas").bounding_box()
    with Image.open(pictures[-1]) as last:
        first_row = round(last.width / mechanism["width"] * mechanism["height"])
        assert near(last, JOURNAL)[first_row:].sum() > 5000


def lasting(content, form):
    """Seconds that a container says it lasts."""
    if form == "WebM":
        at = content.index(b"\x44\x89") + 3  # the element's length is 8, in eight bytes
        return struct.unpack(">d", content[at + 7 : at + 15])[0] / 1000.0
    at = content.index(b"mvhd") + 16
    scale, duration = struct.unpack(">II", content[at : at + 8])
    return duration / scale


def test_a_film_that_cannot_be_says_why(ready):
    ready.get_by_label("Length of the film").select_option("impact")
    ready.get_by_label("Speed").select_option("0.001")
    ready.evaluate("delete window.VideoEncoder")
    ready.get_by_role("button", name="WebM").click()
    ready.get_by_text("This browser makes no webm files; take another form.").wait_for()
    ready.get_by_role("slider", name="Time").fill("0")
    ready.get_by_text("t = 0 s").wait_for()
    ready.get_by_role("button", name="GIF").click()
    ready.get_by_text("No impact is on both sides of the time that is shown").wait_for()


def test_a_slider_and_a_cam_are_shown(browsing, url, artifacts):
    slides = submitted(url, {"kind": "simulate", "scene": sliders.swinging(), "duration": 0.05})
    with browsing.page(f"{url}/#/job/{slides}?t=0.04", still=True) as page:
        page.wait_for_function(MOVED, arg=0)
        page.get_by_text("gap ×19").wait_for()
        drawn(page, "Slider of joint guide in its guide", "tint-0", 500)
        page.screenshot(path=artifacts / "slider.png")
    joint = cams.follower("flat", cams.CIRCLE, lash=1e-4)
    lifts = submitted(url, {"kind": "simulate", "scene": cams.valve(joint), "duration": 0.05})
    with browsing.page(f"{url}/#/job/{lifts}?t=0.04", still=True) as page:
        page.get_by_text("gap ×120").wait_for()  # 30 px are 0.1 mm, and 78 px the mean of 30 mm
        drawn(page, "Follower of joint cam on its cam", "tint-0", 500)
        drawn(page, "Follower of joint cam on its cam", "ground", 2000)
        page.screenshot(path=artifacts / "follower.png")
    with browsing.page(f"{url}/#/editor") as page:
        paste(page, json.dumps(cams.valve(joint)))
        page.get_by_text("Degrees of freedom: 1").wait_for()
        drawn(page, EDITED, "ground", 2000)
        page.screenshot(path=artifacts / "cam.png")


def test_a_mechanism_in_the_editor_is_dragged(browsing, url):
    with browsing.page(f"{url}/#/editor") as page:
        page.get_by_text("of one core").wait_for()  # the last that comes, and moves the drawing
        corner = page.get_by_label(EDITED).bounding_box()

        def pin():
            """Position of the only joint with play, at the crank's end, once all is answered."""
            page.evaluate(REDRAWN)  # the pointer's moves are told to the page once a frame
            page.wait_for_function(ANSWERED, arg=EDITED)
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
