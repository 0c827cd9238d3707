"""Springs, forces, gears and cams in the picture of a mechanism: where they are."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay import figures
from jointplay.figures import colours
from jointplay.figures.mechanism_curves import curves
from jointplay.figures.mechanism_elements import Wheels, circles, elements
from jointplay.figures.mechanism_guides import guides
from jointplay.solver.joints import JOINTS
from jointplay.solver.joints.curves import joint_curves

RADIUS, ECCENTRICITY, ROLLER = 0.03, 0.01, 0.008
KNOTS = np.linspace(0.0, 2.0 * math.pi, 64)
PITCH = -ECCENTRICITY * np.sin(KNOTS) + np.sqrt(
    (RADIUS + ROLLER) ** 2 - (ECCENTRICITY * np.cos(KNOTS)) ** 2
)
WAVE = {"type": "sinusoidal", "offset": RADIUS, "amplitude": -ECCENTRICITY, "frequency": 1.0}
TABLE = {
    "type": "table",
    "knots": KNOTS.tolist(),
    "values": [*PITCH[:-1], PITCH[0]],
    "outside": "periodic",
}
PAIR = {"first": "ground.S", "second": "tappet.F"}
SCENE = {
    "ground": {"points": {"O": [0.0, 0.0], "S": [0.0, 0.2]}},
    "bodies": {
        "shaft": {"points": {"O": [0.0, 0.0]}},
        "tappet": {"points": {"F": [0.0, -0.02]}},
    },
    "joints": {
        "O": {"type": "revolute", "bearing": "ground.O", "journal": "shaft.O"},
        "P": {"type": "revolute", "bearing": "ground.S", "journal": "tappet.F"},
    },
    "gears": {"mesh": {"first": "O", "second": "P", "ratio": -3.0}},
    "forces": {
        "spring": {"type": "spring-damper"} | PAIR,
        "push": {"type": "force", "magnitude": -2.0, "direction": [0.0, 5.0]} | PAIR,
        "pull": {"type": "tension", "magnitude": 2.0} | PAIR,
        "motor": {"type": "motor"} | PAIR,
    },
}
POSE = {"shaft": (0.0, 0.0, 0.7), "tappet": (0.0, 0.05, 0.0)}
FOLLOWERS = {
    "flat": {"type": "flat-follower", "profile": WAVE, "normal": [0.0, 1.0]},
    "roller": {"type": "roller-follower", "profile": TABLE, "roller_radius": ROLLER},
}


def on_cam(shape: str, **fields: Any) -> dict[str, Any]:
    """The scene with a follower on a cam in place of its joints, and the curves of both."""
    joint = FOLLOWERS[shape] | {"cam": "shaft.O", "follower": "tappet.F"} | fields
    checked = JOINTS[joint["type"]].model_validate(joint)
    return SCENE | {"joints": {"cam": joint}, "curves": joint_curves({"cam": checked})}


def guided(length: float) -> dict[str, Any]:
    """A slider of a length [m], twice its height, in a guide that stands upright."""
    place = {"guide": "ground.S", "slider": "tappet.F", "axis": [0.0, 2.0]}
    play = {"wall_clearance": 1e-3, "length": length, "height": 0.5 * length}
    joint = {"type": "prismatic", **place, "clearance": play}
    return SCENE | {"joints": {"guide": joint}, "gears": {}, "forces": {}}


@pytest.mark.parametrize(("length", "larger"), [(0.04, 1.0), (0.004, 5.0)])
def test_a_guide_with_play_shows_its_walls_and_its_slider(length: float, larger: float) -> None:
    (guide,) = guides(guided(length), POSE, extent=0.2)
    assert guide.body == "tappet"
    half = 0.5 * length * larger
    # the slider is at F, 0.03 m up the shaft's side; the guide's axis goes up through S
    np.testing.assert_allclose(np.ptp(guide.slider, axis=0), [half, 2.0 * half])
    np.testing.assert_allclose(guide.slider.mean(axis=0), [0.0, 0.03], atol=1e-12)
    np.testing.assert_allclose(np.ptp(guide.walls[:, :, 0]), half + 2.0 * larger * 1e-3)
    assert np.ptp(guide.walls[0, :, 1]) == pytest.approx(2.2 * 2.0 * half)


def test_a_guide_with_play_is_drawn_and_named_in_the_legend() -> None:
    scene = guided(0.04)
    (axes,) = figures.draw_mechanism(scene, POSE).axes
    (named,) = [line for line in axes.lines if line.get_label() == "joint with clearance"]
    assert named.get_color() == colours.MARKED
    walls = [line for line in axes.lines if line.get_color() == colours.MARKED]
    assert len(walls) == 2
    ideal = scene["joints"]["guide"] | {"clearance": None}
    (axes,) = figures.draw_mechanism(scene | {"joints": {"guide": ideal}}, POSE).axes
    assert colours.MARKED not in [line.get_color() for line in axes.lines]


def test_a_slot_that_is_wide_shows_its_walls_as_the_stops_of_a_slide() -> None:
    place = {"slot": "ground.S", "pin": "tappet.F", "axis": [1.0, 0.0]}
    play = {"wall_clearance": 0.02, "pin_radius": 0.005}
    joint = {"type": "pin-in-slot", **place, "clearance": play}
    scene = SCENE | {"joints": {"stops": joint}, "gears": {}, "forces": {}}
    (stops,) = guides(scene, POSE, extent=0.2)
    assert len(stops.slider) == 0
    level = SCENE["ground"]["points"]["S"][1]  # m
    np.testing.assert_allclose(stops.walls[:, :, 1], level + 0.025 * np.array([[1, 1], [-1, -1]]))
    assert np.ptp(stops.walls[0, :, 0]) == pytest.approx(0.2 * 0.2)
    (axes,) = figures.draw_mechanism(scene, POSE).axes
    marked = [line for line in axes.lines if line.get_color() == colours.MARKED]
    assert len(marked) == 3  # both walls, and the pin
    narrow = joint | {"clearance": play | {"wall_clearance": 1e-3}}
    assert guides(scene | {"joints": {"stops": narrow}}, POSE, extent=0.2) == []


@pytest.mark.parametrize("shape", FOLLOWERS)
def test_the_outline_of_an_eccentric_cam_is_its_circle(shape: str) -> None:
    (outline, filled), (moved, is_outline) = curves(on_cam(shape), POSE)
    assert (filled, is_outline) == (True, False)
    # the circle's centre is below the shaft's, and turns with it
    centre = ECCENTRICITY * np.array([math.sin(0.7), -math.cos(0.7)])
    # of a table of 64 knots
    reach = np.hypot(*(outline - centre).T)
    np.testing.assert_allclose(reach, RADIUS, rtol=0.0, atol=2e-8)
    np.testing.assert_allclose(moved.mean(axis=0), [0.0, 0.03], atol=1e-3)


def test_names_beside_a_flat_face_do_not_lie_on_it() -> None:
    guide = {"type": "prismatic", "guide": "ground.S", "slider": "tappet.F", "axis": [0.0, 1.0]}
    scene = on_cam("flat")
    scene |= {"joints": scene["joints"] | {"guide": guide}, "gears": {}, "forces": {}}
    figure = figures.draw_mechanism(scene, POSE)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    (face,) = [line for line in axes.lines if line.get_linewidth() == 1.2]
    (right, level), (left, _) = axes.transData.transform(face.get_xydata())
    for box in (text.get_window_extent() for text in axes.texts):
        beside = box.x1 < left or right < box.x0
        assert beside or box.y1 < level or level < box.y0


def test_elements_stand_where_their_points_are() -> None:
    spring, push, pull, motor = elements(SCENE, POSE)
    assert (spring.first, spring.second) == ((0.0, 0.2), (0.0, pytest.approx(0.03)))
    assert push.direction == pytest.approx((0.0, -1.0))
    assert pull.direction == pytest.approx((0.0, 1.0))
    assert (spring.direction, motor.direction) == (None, None)


def test_wheels_side_by_side_touch_and_a_belt_has_no_circles() -> None:
    one, two = circles(Wheels((0.0, 0.0), (0.4, 0.0), -3.0))
    # the second turns three times as fast: a third as large
    assert one[0].max() == pytest.approx(0.3)
    assert two[0].min() == pytest.approx(0.3)
    assert circles(Wheels((0.0, 0.0), (0.4, 0.0), 2.0)) == []


def test_all_of_it_is_drawn_within_the_frame() -> None:
    scene = on_cam("flat")
    scene["joints"] |= SCENE["joints"]
    (axes,) = figures.draw_mechanism(scene, POSE).axes
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    for line in axes.lines:
        x, y = np.array(line.get_xdata(), float), np.array(line.get_ydata(), float)
        assert left <= x.min() <= x.max() <= right
        assert low <= y.min() <= y.max() <= high
