"""Files of films: how long they last, and that none is there but a whole one."""

import os
import signal
import subprocess
from dataclasses import replace

import pytest
from closed_form_motion import closed_form_motion
from PIL import Image

from jointplay import figures
from jointplay.figures import NotDrawable, Pace, Selection

CHOSEN = Selection(joints=("left",), start=0.5, stop=0.56)
RATE = 0.2
LASTING = 0.3  # s: 60 ms at a fifth of their speed


@pytest.fixture(scope="module")
def motion():
    return closed_form_motion()


@pytest.fixture(scope="module")
def ffmpeg():
    reason = "no ffmpeg: pip install imageio-ffmpeg"
    return pytest.importorskip("imageio_ffmpeg", reason=reason).get_ffmpeg_exe()


@pytest.fixture
def hears_ctrl_c():
    """Shells start background programs with Ctrl-C ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def delays_of(path):
    with Image.open(path) as film:
        found = []
        for frame in range(film.n_frames):
            film.seek(frame)
            found.append(film.info["duration"])
    return found


def test_a_gif_lasts_as_long_as_slow_motion_makes_it(motion, tmp_path):
    figures.film(motion, tmp_path / "a.gif", CHOSEN, pace=Pace(RATE, 30))
    delays = delays_of(tmp_path / "a.gif")
    assert set(delays) == {30, 40}  # a thirtieth of a second is no multiple of 10 ms
    assert sum(delays) == 1000 * LASTING


def test_a_gif_from_impact_to_impact_has_a_frame_for_each(motion, tmp_path):
    figures.film(motion, tmp_path / "a.gif", CHOSEN, pace=Pace(None, 10, impact_to_impact=True))
    rows = motion.contacts[motion.contacts["joint"] == 0]
    middles = (rows["onset"] + rows["release"]) / 2.0
    impacts = ((middles >= CHOSEN.start) & (middles <= CHOSEN.stop)).sum()
    assert sum(delays_of(tmp_path / "a.gif")) == 100 * impacts > 0


@pytest.mark.parametrize("form", ["mp4", "webm"])
def test_ffmpeg_writes_films_that_last_as_long(motion, tmp_path, ffmpeg, form):
    path = tmp_path / f"a.{form}"
    figures.film(motion, path, CHOSEN, pace=Pace(RATE, 10))
    seen = subprocess.run([ffmpeg, "-i", path, "-f", "null", "-"], capture_output=True, text=True)
    assert "yuv420p" in seen.stderr
    assert "frame=    3" in seen.stderr
    assert f"Duration: 00:00:00.{100 * LASTING:.0f}," in seen.stderr


@pytest.mark.parametrize("form", ["gif", "mp4"])
@pytest.mark.usefixtures("hears_ctrl_c")
def test_a_film_that_is_interrupted_leaves_the_one_before(motion, tmp_path, request, form):
    if form == "mp4":
        request.getfixturevalue("ffmpeg")
    path = tmp_path / f"a.{form}"
    path.write_bytes(b"the film before")

    def interrupt(share):
        if share > 0.5:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        figures.film(motion, path, CHOSEN, pace=Pace(RATE, 10), report=interrupt)
    assert list(tmp_path.iterdir()) == [path]
    assert path.read_bytes() == b"the film before"


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("exit 3", "ffmpeg ended with code 3; "),
        ("cat > /dev/null; echo half > $last; echo ' no room' >&2; exit 1", "code 1: no room; "),
    ],
    ids=["before it read anything", "after it wrote half"],
)
def test_an_ffmpeg_that_fails_leaves_nothing(motion, tmp_path, monkeypatch, script, said):
    failing = tmp_path / "bin" / "ffmpeg"
    failing.parent.mkdir()
    failing.write_text(f"#!/bin/sh\nfor last; do :; done\n{script}\n")
    failing.chmod(0o700)
    monkeypatch.setenv("PATH", str(failing.parent), prepend=os.pathsep)
    made = tmp_path / "made"
    made.mkdir()
    chosen = replace(CHOSEN, stop=0.52)
    with pytest.raises(NotDrawable) as caught:
        figures.film(motion, made / "a.mp4", chosen, pace=Pace(RATE, 30))
    assert said in str(caught.value)
    assert caught.value.cause == "path"
    assert list(made.iterdir()) == []
