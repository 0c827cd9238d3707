"""Films: what their frames show, and what they refuse."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from closed_form_motion import CLEARANCES, closed_form_motion
from PIL import Image

from jointplay import figures
from jointplay.figures import NotDrawable, Pace, Selection
from jointplay.figures.animation.instants import instants
from jointplay.figures.animation.journal import Journal
from jointplay.figures.animation.magnified import DEEPEST, GAP
from jointplay.figures.animation.walls import BetweenWalls
from jointplay.figures.mechanism_marks import TINTS
from jointplay.figures.page import panels

START, STOP, FRAMES = 0.5, 0.74, 12  # the block is beside all else
PACE = Pace(rate=0.2, frames_per_second=10)
CHOSEN = Selection(joints=("left",), start=START, stop=STOP)


@pytest.fixture(scope="module")
def motion():
    return closed_form_motion()


def test_the_frames_of_a_gif_show_bodies_where_the_channels_say(motion, tmp_path):
    told = []
    figures.film(motion, tmp_path / "a.gif", CHOSEN, pace=PACE, report=told.append)
    assert told == [(frame + 1) / FRAMES for frame in range(FRAMES)]
    block = np.array([int(TINTS[2][k : k + 2], 16) for k in (1, 3, 5)])
    seen = []
    with Image.open(tmp_path / "a.gif") as film:
        assert (film.n_frames, film.width, film.info["duration"]) == (FRAMES, 642, 100)
        for frame in range(FRAMES):
            film.seek(frame)
            far = np.abs(np.asarray(film.convert("RGB"), int) - block).max(axis=2)
            seen.append(np.median(np.nonzero(far < 3)[1]))
    times = START + 0.02 * np.arange(FRAMES)
    x = 0.56 + 0.2 * np.sin(np.pi * times)
    slope, offset = np.polyfit(x, seen, 1)
    np.testing.assert_allclose(seen, offset + slope * x, atol=1.5)  # pixels
    assert slope * np.ptp(x) > 25.0


def test_a_frame_alone_is_a_figure(motion):
    inset, mechanism = figures.draw(motion, "animation", CHOSEN).axes
    assert mechanism.get_title("left") == "t = 0.5 s"
    assert inset.get_title("left").splitlines()[0] == "left, no contact"
    # a gap of 0.5 mm about a journal of 10 mm
    assert f"gap ×{GAP * 0.01 / CLEARANCES['left']:.2g}" in inset.get_title("left")


@pytest.mark.parametrize(
    ("rate", "words"),
    [(1e-3, ", 1000 times slower"), (3e-4, ", 3330 times slower"), (0.4, ", 2.5 times slower")],
)
def test_the_slowness_of_a_film_is_written_out(motion, tmp_path, monkeypatch, rate, words):
    written = []  # it was ``1e+03 times slower``
    monkeypatch.setattr(
        "jointplay.figures.animation.reel.page.corner_text", lambda _, text: written.append(text)
    )
    chosen = replace(CHOSEN, stop=START + 2.0 * rate)
    figures.film(motion, tmp_path / "a.gif", chosen, pace=Pace(rate=rate, frames_per_second=2))
    above = [text for text in written if text.startswith("t = ")]
    assert above
    assert all(text.endswith(words) for text in above)


def centre_of(axes):
    (dot,) = (line for line in axes.lines if line.get_marker() == "o")
    return float(dot.get_xdata()[0]), float(dot.get_ydata()[0])


def test_a_factor_of_penetration_is_told_where_there_is_one(motion):
    told = []
    for start in (0.0, START):  # the journal begins in the middle of its bearing
        inset, _ = figures.draw(motion, "animation", replace(CHOSEN, start=start)).axes
        told.append("penetration ×" in inset.get_title("left"))
    assert told == [False, True]


@pytest.mark.parametrize(("distance", "shown"), [(0.0, 0.0), (2e-4, 0.5 * GAP), (4e-4, GAP)])
def test_a_journal_moves_through_its_gap_and_goes_deeper_in_the_wall(distance, shown):
    joint = {"clearance": {"radial_clearance": 4e-4, "bearing_radius": 0.01}}
    columns = {
        "A.eccentricity_x": np.array([0.6, 0.6]) * [distance, 4.1e-4],
        "A.eccentricity_y": np.array([0.8, 0.8]) * [distance, 4.1e-4],
        "A.normal_force": np.array([0.0, 50.0]),
    }
    journal = Journal("A", {"joints": {"A": joint}}, columns)
    _, ((free, touching),) = panels(1, 2, 50.0)
    journal.draw(free, 0, {})
    journal.draw(touching, 1, {})
    assert centre_of(free) == pytest.approx((0.6 * shown, 0.8 * shown))
    deep = GAP + DEEPEST
    assert centre_of(touching) == pytest.approx((0.6 * deep, 0.8 * deep))
    assert not free.texts
    (arrow,) = touching.texts
    assert arrow.xy == pytest.approx((0.6 * (deep + 1.0 - GAP), 0.8 * (deep + 1.0 - GAP)))


@pytest.mark.parametrize("tilt", [0.0, 0.4])
def test_a_tilted_slider_touches_with_two_opposite_corners(tilt):
    clearance = {"wall_clearance": 1e-3, "length": 0.1, "height": 0.05}
    joint = {"type": "prismatic", "guide": "link.G", "axis": [0.0, 2.0], "clearance": clearance}
    columns = {}
    for corner, depth in zip((1, 2, 3, 4), (0.0, -2e-3, 0.0, -2e-3), strict=True):
        columns[f"guide.corner_{corner}.penetration"] = np.array([depth])
        columns[f"guide.corner_{corner}.normal_force"] = np.array([2.0 + depth])
    slider = BetweenWalls("guide", {"joints": {"guide": joint}}, columns)
    _, ((axes,),) = panels(1, 1, 50.0)
    slider.draw(axes, 0, {"link": (0.0, 0.0, tilt)})
    left, right = (line.get_xydata() for line in axes.lines)  # upright: the axis is y
    normal = np.array([-np.cos(tilt), -np.sin(tilt)])
    across = axes.patches[-1].get_xy()[:4] @ normal
    np.testing.assert_allclose(across[[0, 2]], [(left @ normal)[0], (right @ normal)[0]])
    assert (abs(across[[1, 3]]) < abs(across[[0, 2]])).all()


def test_films_that_cannot_be_are_refused(motion, tmp_path, monkeypatch):
    def refused(name="a.gif", selection=CHOSEN, pace=PACE):
        with pytest.raises(NotDrawable) as caught:
            figures.film(motion, tmp_path / name, selection, pace=pace)
        assert list(tmp_path.iterdir()) == []
        return str(caught.value), caught.value.cause

    assert "2400 frames, and 300 are the most" in refused(pace=Pace(1e-3, 10))[0]
    last = replace(CHOSEN, start=1.95, stop=1.96)
    assert "no impacts" in refused(selection=last, pace=Pace(impact_to_impact=True))[0]
    assert refused(name="a.avi")[1] == "path"
    assert refused(pace=Pace(0.2, 60))[1] == "frames_per_second"  # a GIF's delays are 20 ms or more
    assert refused(selection=replace(CHOSEN, joints=("O",)))[1] == "joints"
    assert refused(selection=replace(CHOSEN, start=9.0, stop=10.0))[1] == "start"
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setenv("PATH", "")
    assert "pip install 'jointplay[film]'" in refused(name="a.mp4")[0]
    for wrong in (
        {"rate": 0.0},
        {"rate": 1.0, "impact_to_impact": True},
        {"rate": float("nan")},
        {"frames_per_second": 0},
    ):
        with pytest.raises(NotDrawable):
            Pace(**wrong)


def test_from_impact_to_impact_each_frame_is_the_middle_of_one(motion):
    times = instants(motion, CHOSEN, Pace(impact_to_impact=True)).times
    rows = motion.contacts[motion.contacts["joint"] == 0]
    middles = (rows["onset"] + rows["release"]) / 2.0
    np.testing.assert_array_equal(times, middles[(middles >= START) & (middles <= STOP)])
    assert len(times) > 1
