"""Poses of scenes over HTTP: at t = 0, as the drivers go on, and dragged by a point."""

import math

import pytest

from jointplay.solver.kinds.assembled import assembled_scene
from tests.solver.cams import CIRCLE, RADIUS, follower, valve
from tests.two_assemblies import arm, five_bar, toggle


def posed(http, scene, **more):
    return http.post("/v1/scenes/poses", json={"scene": scene, **more})


@pytest.mark.parametrize(
    "scene",
    [{"preset": "seven-bar-press"}, {"preset": "pendulum"}, toggle(), five_bar()],
    ids=["press", "pendulum", "toggle", "five-bar"],
)
def test_the_pose_is_that_in_which_the_scene_is_run(http, scene):
    answer = posed(http, scene)
    assert answer.status_code == 200
    found = answer.json()
    expected = assembled_scene(scene, is_whole=True).pose()
    assert (found["times"], found["stopped"]) == ([0.0], None)
    assert found["poses"] == [{body: list(pose) for body, pose in expected.items()}]


def test_curves_come_along_that_joints_are_drawn_by(http):
    assert posed(http, toggle()).json()["curves"] == []
    cam, face = posed(http, valve(follower("flat", CIRCLE, lash=1e-4))).json()["curves"]
    shown = [(one["joint"], one["about"], one["filled"]) for one in (cam, face)]
    assert shown == [("cam", "shaft.O", True), ("cam", "tappet.F", False)]
    # a circle whose rightmost point is right of its centre
    assert max(x for x, _ in cam["points"]) == pytest.approx(RADIUS - 1e-4)


def test_bodies_move_as_drivers_prescribe(http):
    motion = {"type": "sinusoidal", "amplitude": 0.5, "frequency": 4.0, "phase": math.pi / 2}
    found = posed(http, arm(position=0.2, motion=motion), times=[0.0, math.pi / 4]).json()
    angles = [pose["arm"][2] for pose in found["poses"]]
    assert angles == pytest.approx([0.7, -0.3])
    assert (found["drivers_time"], found["repeats"]) == (pytest.approx(math.pi / 2), True)


@pytest.mark.parametrize(
    ("speed", "seconds", "repeats"),
    [(4.0, math.pi, True), (math.sqrt(10.0), 2.0 * math.pi / math.sqrt(10.0), False)],
)
def test_drivers_that_turn_at_two_speeds_are_shown_until_both_are_back(
    http, speed, seconds, repeats
):
    scene = two_arms(10.0, speed)
    found = posed(http, scene).json()
    assert (found["drivers_time"], found["repeats"]) == (pytest.approx(seconds), repeats)
    turn = http.post("/v1/scenes/check", json=scene).json()["turn"]
    assert turn["span"] == pytest.approx(seconds), "what is checked is what is shown"
    assert ("come round" in turn["detail"]) == repeats


def test_of_drivers_some_of_which_are_slow_no_more_is_shown_than_can_be_seen(http):
    found = posed(http, two_arms(10.0, 0.01)).json()
    assert (found["drivers_time"], found["repeats"]) == (pytest.approx(4.0 * math.pi), False)


def two_arms(first, second):
    """Return two arms on one pin of the ground that turn at these speeds."""
    scene, other = arm(speed=first), arm(speed=second)
    scene["bodies"]["other"] = other["bodies"]["arm"]
    scene["joints"]["P"] = other["joints"]["O"] | {"journal": "other.O"}
    scene["drivers"]["second"] = other["drivers"]["motor"] | {"joint": "P"}
    return scene


def test_it_is_said_where_drivers_stop(http):
    motion = {"type": "table", "knots": [0, 1, 3], "values": [0, 1, 2], "outside": "refused"}
    found = posed(http, arm(motion=motion), times=[0.0, 1.0, 4.0]).json()
    assert found["times"] == [0.0, 1.0]
    assert len(found["poses"]) == 2
    assert found["stopped"]["time"] == pytest.approx(3.0, abs=1e-3)
    assert "'motor'" in found["stopped"]["detail"]


def test_a_point_is_dragged_and_dragged_on(http):
    scene = {"preset": "four-bar"}
    drag = {"scene": scene, "point": "crank.B", "position": [0.1, 0.3]}
    first = http.post("/v1/scenes/drag", json=drag)
    assert first.status_code == 200
    pose = first.json()["pose"]
    assert pose["crank"][2] == pytest.approx(math.atan2(0.3, 0.1), abs=1e-2)
    drag |= {"position": [-0.3, 0.1], "pose": pose}
    pose = http.post("/v1/scenes/drag", json=drag).json()["pose"]
    assert pose["crank"][2] == pytest.approx(math.atan2(0.1, -0.3), abs=1e-2)


FOUR_BAR = {"preset": "four-bar"}


@pytest.mark.parametrize(
    ("resource", "document", "pointer"),
    [
        ("poses", {}, "/scene"),
        ("poses", [1], ""),
        ("poses", {"scene": {"preset": "five-bar"}}, "/scene/preset"),
        ("poses", {"scene": {"preset": "seven-bar-test-bed"}}, "/scene/parameters/pivot_distance"),
        ("poses", {"scene": FOUR_BAR, "times": []}, "/times"),
        ("poses", {"scene": FOUR_BAR, "times": [0.0] * 513}, "/times"),
        ("poses", {"scene": FOUR_BAR, "times": [0.0, -1.0]}, "/times/1"),
        ("poses", {"scene": FOUR_BAR, "times": [0.0, 0.2, 0.1]}, "/times/2"),
        ("poses", {"scene": FOUR_BAR, "times": [1e6]}, "/times"),
        ("poses", {"scene": FOUR_BAR, "time": [1.0]}, "/time"),
        ("drag", {"scene": FOUR_BAR, "point": "crank.B"}, "/position"),
        ("drag", {"scene": FOUR_BAR, "point": "crank", "position": [0, 0]}, "/point"),
        ("drag", {"scene": FOUR_BAR, "point": "ground.A", "position": [0, 0]}, "/point"),
        ("drag", {"scene": FOUR_BAR, "point": "crank.B", "position": [0]}, "/position/1"),
        (
            "drag",
            {
                "scene": FOUR_BAR,
                "point": "crank.B",
                "position": [0, 0],
                "pose": {"crank": [0, 0, 0]},
            },
            "/pose",
        ),
    ],
)
def test_what_cannot_be_posed_is_refused_at_its_field(http, resource, document, pointer):
    answer = http.post(f"/v1/scenes/{resource}", json=document)
    assert answer.status_code == 422
    assert pointer in [one["pointer"] for one in answer.json()["errors"]]


def test_a_position_of_one_coordinate_is_too_short(http):
    document = {"scene": FOUR_BAR, "point": "crank.B", "position": [0]}
    (problem,) = http.post("/v1/scenes/drag", json=document).json()["errors"]
    assert problem == {
        "pointer": "/position/1",
        "detail": "'position' has 1 entries, and needs more.",
    }
