"""A given pose holds if the joints allow it; else the nearest one is taken."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.mechanics.assemblies import assemblies
from jointplay.solver.scene.document import Scene
from tests.solver.mechanics.start.mechanisms import (
    ELASTIC,
    ball,
    bar,
    cradle,
    lever,
    put_together,
    revolute,
    slider_crank,
    toggle,
)
from tests.two_assemblies import arm


def test_the_assembly_nearest_to_a_drawn_point_is_taken() -> None:
    # the knee is drawn within 9 mm of one assembly, 31 cm from another; the ram is not drawn, and
    # its two positions are told apart by its guide, whose middle is nearer to the lower one
    found, pose, _ = put_together(toggle({"rod.K": [-0.06, 0.21]}))
    angle = pose["rod"][2]
    knee = pose["rod"][:2] + 0.15 * np.array([math.cos(angle), math.sin(angle)])
    assert math.dist(knee, (-0.06, 0.21)) < 0.01
    assert pose["ram"][1] < 0.0
    (one,) = found.misfits
    assert one.pointer == "/start/points/rod.K"
    assert one.off == pytest.approx(math.dist(one.given, one.taken))


@pytest.mark.parametrize("k", range(4))
def test_every_assembly_is_taken_that_its_angles_and_points_are_given_of(k: int) -> None:
    scene = Scene.model_validate(toggle({"rod.K": [-0.06, 0.21]}))
    ways = assemblies(scene)
    document = scene.model_dump(mode="json")
    position = [round(ways.positions[k]["ram"][axis], 3) for axis in (0, 1)]
    angles = {body: round(angle, 2) for body, angle in ways.angles[k].items() if body != "crank"}
    document["start"] = {"angles": angles, "points": {"ram.S": [position[0], position[1] + 0.05]}}
    _, pose, _ = put_together(document)
    for body, (x, y) in ways.positions[k].items():
        np.testing.assert_allclose(pose[body][:2], (x, y), rtol=0, atol=1e-9)


def test_one_point_of_each_body_is_enough() -> None:
    found, pose, _ = put_together(
        slider_crank({"points": {"slider.c": [0.4, 0], "crank.b": [0.2, -0.4583]}})
    )
    assert pose["slider"][0] == pytest.approx(0.4, abs=1e-12)  # held: the other fits to 4 digits
    assert pose["crank"][2] == pytest.approx(-math.acos(0.4), abs=1e-12)
    assert [one.pointer for one in found.misfits] == ["/start/points/crank.b"]


def test_a_point_alone_moves_the_bodies_of_which_nothing_is_given() -> None:
    found, pose, _ = put_together(slider_crank({"points": {"slider.c": [0.4, 0]}}))
    assert pose["slider"][0] == pytest.approx(0.4, abs=1e-12)
    assert not found.misfits


def test_a_given_angle_holds_and_the_rest_is_fitted() -> None:
    found, pose, _ = put_together(slider_crank({"angles": {"crank": 0.3, "rod": -1.0}}))
    assert pose["crank"][2] == pytest.approx(0.3, abs=1e-12)
    assert pose["rod"][2] == pytest.approx(-0.3, abs=1e-12)
    (one,) = found.misfits
    assert (one.pointer, one.given, one.off) == (
        "/start/angles/rod",
        (-1.0,),
        pytest.approx(0.25 * 0.7),
    )


def test_a_ball_that_is_drawn_above_a_floor_starts_there() -> None:
    assert put_together(ball({"points": {"ball.c": [2, 10]}}))[1]["ball"][1] == 10.0
    assert put_together(ball({}))[1]["ball"][1] == pytest.approx(0.101)
    found, pose, _ = put_together(
        ball({"points": {"ball.c": [0, 10]}, "guides": {"floor": {"offset": 3}}})
    )
    assert pose["ball"][1] == pytest.approx(3.101)  # where a joint starts comes first
    assert [one.pointer for one in found.misfits] == ["/start/points/ball.c"]


@pytest.mark.parametrize("others", [{}, {"b1": 0.0, "b2": 0.0}])
def test_the_first_ball_of_a_cradle_is_lifted_alone(others: dict[str, float]) -> None:
    _, pose, _ = put_together(cradle({"angles": {"b0": -0.2, **others}}))
    assert [pose[f"b{i}"][2] for i in range(3)] == pytest.approx([-0.2, 0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize("stop", ["slot", "pin"])
def test_a_given_angle_within_the_play_of_a_stop_holds(stop: str) -> None:
    _, pose, _ = put_together(lever(stop, {"angles": {"lever": 0.15}}))
    assert pose["lever"][2] == pytest.approx(0.15, abs=1e-12)


@pytest.mark.parametrize("stop", ["slot", "pin"])
def test_a_given_angle_beyond_the_play_of_a_stop_does_not(stop: str) -> None:
    found, pose, _ = put_together(lever(stop, {"angles": {"lever": 0.3}}))
    assert pose["lever"][2] == pytest.approx(0.0, abs=1e-9)
    (one,) = found.misfits
    assert (one.given, one.taken) == ((0.3,), (pytest.approx(0.0, abs=1e-9),))


@pytest.mark.parametrize("stop", ["slot", "pin"])
def test_one_value_that_cannot_hold_closes_no_play_that_another_needs(stop: str) -> None:
    away = {"angles": {"lever": 0.15}, "points": {"lever.b": [3.0, 0.0]}}
    found, pose, _ = put_together(lever(stop, away))
    assert pose["lever"][2] == pytest.approx(0.15, abs=1e-12)
    assert [one.pointer for one in found.misfits] == ["/start/points/lever.b"]
    position = [math.cos(0.15), math.sin(0.15)]
    found, pose, _ = put_together(
        lever(stop, {"angles": {"lever": 0.3}, "points": {"lever.b": position}})
    )
    assert pose["lever"][2] == pytest.approx(0.15, abs=1e-9)
    assert [one.pointer for one in found.misfits] == ["/start/angles/lever"]


@pytest.mark.parametrize(
    ("offset", "tilt", "taken"),
    [
        (0.0, 0.015, (0.0, 0.015)),
        (0.0, 0.03, (0.0, 0.0)),
        (2e-4, 0.015, (2e-4, 0.015)),
        (5e-4, 0.015, (0.0, 0.015)),  # the angle holds, and comes first
    ],
)
def test_a_slider_is_within_its_play_with_its_corners(
    offset: float, tilt: float, taken: tuple[float, float]
) -> None:
    """Corners 50 mm before and behind its point are aside by 50 mm times the tilt."""
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "block.c", "axis": [1, 0]}
    play = {"wall_clearance": 1e-3, "length": 0.1, "height": 0.05, "contact": ELASTIC}
    document = {
        "name": "block",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {"block": {"mass": 1.0, "inertia": 0.1, "points": {"c": [0, 0]}}},
        "joints": {"guide": guide | {"clearance": play}},
        "start": {"angles": {"block": tilt}, "points": {"block.c": [0.0, offset]}},
    }
    _, pose, _ = put_together(document)
    np.testing.assert_allclose(pose["block"], [0.0, *taken], rtol=0, atol=1e-12)


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.2, 0.4), st.floats(0.55, 0.9), st.floats(-3.0, 3.0), st.sampled_from([-1.0, 1.0])
)
def test_a_roughly_drawn_knee_chooses_its_side(
    crank: float, rod: float, angle: float, side: float
) -> None:
    """A knee of two bars between the ground and a point that is given: circles meet twice.

    Both are as far apart as twice the knee's height; a drawing is rough by less than a third of it.
    """
    reach = crank + rod
    x = 0.8 * reach
    along = (crank**2 - rod**2 + x**2) / (2.0 * x)
    height = math.sqrt(crank**2 - along**2)
    rough = [along, side * height * 0.7]
    document = slider_crank(
        {"points": {"slider.c": [x, 0], "crank.b": rough}, "angles": {"rod": angle}},
        0.5 * crank,
        0.5 * rod,
    )
    del document["start"]["angles"]
    document["drivers"] = {"hold": {"joint": "guide", "position": x, "speed": 0.0}}
    found, pose, _ = put_together(document)
    knee = 2.0 * pose["crank"][:2]
    assert found.residual < 1e-11
    np.testing.assert_allclose(knee, [along, side * height], rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("kind", "ends"), [("prismatic", ("guide", "slider")), ("pin-in-slot", ("slot", "pin"))]
)
def test_what_slides_begins_at_its_guides_point_if_nothing_is_given(
    kind: str, ends: tuple[str, str]
) -> None:
    """It began where the axis is nearest to the world's origin, so that a moved scene differed."""
    guide = {"type": kind, ends[0]: "ground.G", ends[1]: "cart.b", "axis": [1.0, 2.0]}
    document = {
        "name": "cart",
        "ground": {"points": {"G": [1.0, 0.2]}},
        "bodies": {"cart": bar(0.1), "rod": bar(0.3)},
        "joints": {"guide": guide, "pin": revolute("cart.a", "rod.a")},
        "start": {"angles": {"rod": -1.2}},
    }
    found, pose, _ = put_together(document)
    assert found.freedom == {"prismatic": 2, "pin-in-slot": 3}[kind]
    np.testing.assert_allclose(pose["cart"], [0.9, 0.2, 0.0], rtol=0, atol=1e-12)
    document["start"] = {"points": {"rod.b": [1.5, 1.0]}}  # which says where both are
    assert put_together(document)[0].misfits == []


def test_whole_turns_of_a_given_angle_are_kept() -> None:
    document = lever("slot", {"angles": {"lever": 7.0}})
    del document["joints"]["stop"]
    assert put_together(document)[1]["lever"][2] == 7.0


def held_four_bar(rod: float, hung: int = 0) -> dict[str, Any]:
    """Return a four-bar with a coupler of 0.35 m, at -0.9623 or 0.4851 rad, and a chain on it."""
    document = slider_crank({"angles": {"rod": rod}}, 0.05, 0.175)
    document["ground"]["points"]["D"] = [0.4, 0.0]
    document["bodies"]["slider"] = bar(0.125)
    document["joints"] |= {
        "B": revolute("slider.b", "rod.b"),
        "guide": revolute("ground.D", "slider.a"),
    }
    document["drivers"] = {"hold": {"joint": "O", "position": 1.0, "speed": 0.0}}
    above = "slider.b"
    for k in range(hung):
        document["bodies"][f"hung{k}"] = bar(0.1)
        document["joints"][f"hung{k}"] = revolute(above, f"hung{k}.a")
        above = f"hung{k}.b"
    return document


def test_an_angle_that_nothing_says_has_no_whole_turns() -> None:
    """Else a torsion spring would be wound up by 2 pi; the rocker's angle is that by circles."""
    document = held_four_bar(0.0)
    del document["drivers"]
    document["ground"]["points"]["D"] = [-0.1, 0.4]
    document["start"] = {"angles": {"crank": 1.2}}
    _, pose, _ = put_together(document)
    assert pose["crank"][2] == pytest.approx(1.2, abs=1e-12)
    assert pose["slider"][2] == pytest.approx(3.878783 - 2.0 * math.pi, abs=1e-6)


SWAYED: dict[str, Any] = {
    "course": {"type": "constant", "value": 1.0},
    "over": {"quantity": "angle"},
    "moment": 1.0,
}


@pytest.mark.parametrize("first", ["crank.b", "rod.a"])
@pytest.mark.parametrize(
    "force", [{"type": "torsion-spring", "stiffness": 1.0}, {"type": "torque"} | SWAYED]
)
def test_bodies_whose_angle_a_force_follows_are_within_half_a_turn_of_each_other(
    force: dict[str, Any], first: str
) -> None:
    """Both are drawn by points, to 4 digits, 0.3 rad apart, on either side of half a turn."""
    second = {"crank.b": "rod.a", "rod.a": "crank.b"}[first]
    points = {"crank.b": [-0.49, 0.0993], "rod.b": [-0.98746, 0.0494]}
    document = slider_crank({"points": points})
    for part, name in (("bodies", "slider"), ("joints", "B"), ("joints", "guide")):
        del document[part][name]
    document["forces"] = {"turned": force | {"first": first, "second": second}}
    _, pose, _ = put_together(document)
    assert pose["rod"][2] - pose["crank"][2] == pytest.approx(0.3, abs=2e-3)
    document["start"]["angles"] = {"crank": 2.9416, "rod": -3.0416}  # given turns are kept
    _, pose, _ = put_together(document)
    assert pose["rod"][2] - pose["crank"][2] == pytest.approx(0.3 - 2.0 * math.pi, abs=2e-3)


@pytest.mark.parametrize("turns", [-2, -1, 0, 1, 2])
@pytest.mark.parametrize("coupler", [-0.9623, 0.4851])
def test_a_rough_angle_chooses_its_assembly_in_any_turn(turns: int, coupler: float) -> None:
    """The two angles of a coupler of 0.35 m are those that circles meet at, by hand."""
    wanted = coupler + 2.0 * math.pi * turns
    document = held_four_bar(wanted + 0.1)
    assert put_together(document)[1]["rod"][2] == pytest.approx(wanted, abs=1e-4)


@pytest.mark.parametrize("position", [(0.0, 0.2), (0.05, -0.3), (-0.31, 0.02), (-0.5, 0.5)])
def test_a_body_points_to_what_it_cannot_reach_and_is_not_wound_up(
    position: tuple[float, float],
) -> None:
    scene = arm() | {"drivers": {}, "start": {"points": {"arm.E": list(position)}}}
    _, pose, _ = put_together(scene)
    assert pose["arm"][2] == pytest.approx(math.atan2(position[1], position[0]), abs=1e-7)


@pytest.mark.parametrize("bodies", [9, 16])
def test_a_rough_angle_chooses_its_assembly_of_many_bodies(bodies: int) -> None:
    document = held_four_bar(-0.88, bodies - 3)
    assert put_together(document)[1]["rod"][2] == pytest.approx(-0.9623, abs=1e-4)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_what_rough_values_leave_free_starts_at_zero_and_in_the_middle(side: float) -> None:
    """A bar hung on a rod was turned by some angle, and a block off its guide's point, by chance.

    Both angles of crank and rod cannot hold: 0.9 and -0.5 do not meet the slider's line.
    """
    start = {"angles": {"crank": 0.9 * side, "rod": -0.5 * side}}
    document = slider_crank(start, 0.25, 0.4)
    document["ground"]["points"]["G"] = [-1.0, 0.3]
    document["bodies"] |= {"hung": bar(0.3), "block": bar(0.1)}
    document["joints"] |= {
        "hinge": revolute("rod.a", "hung.a"),
        "rails": {"type": "prismatic", "guide": "ground.G", "slider": "block.a", "axis": [3, side]},
    }
    found, pose, _ = put_together(document)
    assert found.misfits
    assert pose["hung"][2] == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(pose["block"], [-0.9, 0.3, 0.0], rtol=0, atol=1e-9)


@pytest.mark.parametrize("rocker", [0.0, math.pi])
def test_bars_that_are_drawn_in_line_and_do_not_meet_are_put_together(rocker: float) -> None:
    """In line no step of Newton's iteration leaves the line: 0.025 m or 0.05 m remained open.

    The crank is kept; rod and rocker meet where circles about their other ends do.
    """
    document = {
        "name": "four-bar",
        "ground": {"points": {"O": [0, 0], "C": [0.3, 0]}},
        "bodies": {"crank": bar(0.05), "rod": bar(0.125), "rocker": bar(0.075)},
        "joints": {
            "A": revolute("ground.O", "crank.a"),
            "B": revolute("crank.b", "rod.a"),
            "C": revolute("rod.b", "rocker.b"),
            "D": revolute("ground.C", "rocker.a"),
        },
        "start": {"angles": {"crank": 0.0, "rod": 0.0, "rocker": rocker}},
    }
    found, pose, _ = put_together(document)
    assert found.residual < 1e-12
    cosine = (0.25**2 + 0.2**2 - 0.15**2) / (2.0 * 0.25 * 0.2)
    assert pose["crank"][2] == pytest.approx(0.0, abs=1e-9)
    assert abs(pose["rod"][2]) == pytest.approx(math.acos(cosine), abs=1e-9)
