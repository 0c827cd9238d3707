"""Given velocities hold if the joints allow it; the rest is fitted."""

import math
from typing import Any

import numpy as np
import pytest

from tests.solver.completed_runs import run
from tests.solver.mechanics.start.mechanisms import (
    STOPS,
    ball,
    bar,
    cradle,
    lever,
    put_together,
    revolute,
    slider_crank,
    toggle,
)
from tests.solver.readable_mechanics import preset


@pytest.mark.parametrize("rate", [0.0, 1.0, -0.9954092474376708])
def test_the_driven_pendulum_starts_at_the_rate_of_its_parameter(rate: float) -> None:
    scene = preset("driven-pendulum", speed=4.0, angular_velocity=rate)
    found, _, velocity = put_together(scene.model_dump(mode="json"))
    assert velocity["rod"][2] == pytest.approx(rate, abs=1e-13)
    assert not found.misfits
    parameters = {"speed": 4.0, "angular_velocity": rate}
    done = run("driven-pendulum", 0.01, parameters=parameters)
    assert done["rod.omega"][0] == pytest.approx(rate, abs=1e-13)


def test_the_rate_of_one_body_of_a_loop_moves_the_others() -> None:
    start = {"angles": {"crank": 0, "rod": 0}, "points": {"rod.b": [1.1, 0]}}
    start |= {"angular_velocities": {"crank": -2.5}}
    _, _, velocity = put_together(slider_crank(start, 0.15, 0.4))
    assert velocity["crank"][2] == pytest.approx(-2.5, abs=1e-13)
    assert velocity["rod"][2] == pytest.approx(2.5 * 0.3 / 0.8, abs=1e-13)


@pytest.mark.parametrize("stop", STOPS)
@pytest.mark.parametrize("thrown", [{}, {"velocities": {"lever": [0, -1.5]}}])
def test_a_given_rate_holds_beside_play(stop: str, thrown: dict[str, object]) -> None:
    found, _, velocity = put_together(lever(stop, {"angular_velocities": {"lever": -3.0}} | thrown))
    np.testing.assert_allclose(velocity["lever"], [0.0, -1.5, -3.0], rtol=0, atol=1e-13)
    assert not found.misfits


def test_a_lever_strikes_its_stop_when_and_as_fast_as_it_must() -> None:
    done = run(lever("slot", {"angular_velocities": {"lever": -3.0}}), 0.1, tolerance=1e-9)
    first = done.contacts("stop.wall_2")[0]
    turned = math.asin(0.2)
    assert first["onset"] == pytest.approx(turned / 3.0, rel=1e-9)
    assert first["approach_rate"] == pytest.approx(3.0 * math.cos(turned), rel=1e-8)


def test_rates_that_contradict_one_another_are_held_in_their_order_and_told() -> None:
    start = {"angles": {"crank": 0.5}, "angular_velocities": {"crank": 2.0, "rod": 5.0}}
    found, _, velocity = put_together(slider_crank(start))
    assert velocity["crank"][2] == pytest.approx(2.0, abs=1e-13)
    assert velocity["rod"][2] == pytest.approx(-2.0, abs=1e-12)
    (one,) = found.misfits
    assert (one.pointer, one.given) == ("/start/angular_velocities/rod", (5.0,))
    assert one.sentence == "The start has -2 rad/s for 5 at /start/angular_velocities/rod."


def test_values_that_differ_late_are_told_to_the_digit_that_does() -> None:
    start = {"angles": {"crank": 0.5}, "angular_velocities": {"crank": 20.0, "rod": -20.00004}}
    (one,) = put_together(slider_crank(start))[0].misfits
    assert one.sentence == "The start has -20 rad/s for -20.00004 at /start/angular_velocities/rod."


def test_a_rate_that_a_driver_prescribes_otherwise_is_told() -> None:
    document = toggle({"rod.K": [-0.0518, 0.2068]})
    document["start"]["angular_velocities"] = {"crank": 0.0}
    found, _, velocity = put_together(document)
    assert velocity["crank"][2] == pytest.approx(12.566, abs=1e-13)
    assert "/start/angular_velocities/crank" in [one.pointer for one in found.misfits]


def test_parts_of_a_joint_with_play_move_with_one_another() -> None:
    document = slider_crank({"angles": {"crank": 0.5}, "angular_velocities": {"crank": 2.0}})
    play = STOPS["pin"]["clearance"] | {"radial_clearance": 1e-4, "bearing_radius": 0.01}
    document["joints"]["A"] |= {"clearance": play}
    _, _, velocity = put_together(document)
    assert velocity["crank"][2] == pytest.approx(2.0, abs=1e-13)
    assert velocity["rod"][2] == pytest.approx(-2.0, abs=1e-11)


def test_a_body_that_is_thrown_carries_nothing_along() -> None:
    angles = {"b0": -0.2, "b1": 0.0, "b2": 0.0}
    document = cradle({"angles": angles, "angular_velocities": {"b0": 1.0}})
    _, _, velocity = put_together(document)
    assert [velocity[f"b{i}"][2] for i in range(3)] == pytest.approx([1.0, 0.0, 0.0], abs=1e-13)


def test_a_body_whose_centre_is_thrown_carries_nothing_along_through_play() -> None:
    document = slider_crank({"angles": {"crank": 0.5}, "velocities": {"slider": [1.5, 0.0]}})
    play = STOPS["pin"]["clearance"] | {"radial_clearance": 1e-4, "bearing_radius": 0.01}
    document["joints"]["B"] |= {"clearance": play}
    _, _, velocity = put_together(document)
    np.testing.assert_allclose(velocity["slider"], [1.5, 0.0, 0.0], rtol=0, atol=1e-13)
    np.testing.assert_allclose(velocity["crank"], np.zeros(3), rtol=0, atol=1e-13)


def test_a_bar_that_hangs_on_a_thrown_one_goes_along_without_turning() -> None:
    document = {
        "name": "two-bars",
        "bodies": {"thrown": bar(0.5), "hung": bar(0.5)},
        "joints": {"pin": revolute("thrown.b", "hung.a")},
        "start": {"velocities": {"thrown": [0.0, 1.0]}, "angular_velocities": {"thrown": 0.0}},
    }
    _, _, velocity = put_together(document)
    np.testing.assert_allclose(velocity["hung"], [0.0, 1.0, 0.0], rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("given", "moves", "turns"),
    [({"angular_velocities": {"rod": 2.0}}, 0.0, 2.0), ({"velocities": {"rod": [1, 0]}}, 1.0, 0.0)],
)
def test_a_slide_rests_and_a_body_does_not_turn_unless_it_is_said(
    given: dict[str, Any], moves: float, turns: float
) -> None:
    """A pendulum below a cart on rails: neither shares what is given of the other."""
    rod = {"mass": 1.0, "inertia": 0.02, "points": {"a": [0.0, 0.3]}}
    guide = {"type": "prismatic", "guide": "ground.G", "slider": "cart.a", "axis": [1.0, 0.0]}
    document = {
        "name": "cart",
        "ground": {"points": {"G": [1.0, 0.0]}},
        "bodies": {"cart": bar(0.1), "rod": rod},
        "joints": {"guide": guide, "pin": revolute("cart.a", "rod.a")},
        "start": given,
    }
    found, _, velocity = put_together(document)
    np.testing.assert_allclose(velocity["cart"], [moves, 0.0, 0.0], rtol=0, atol=1e-13)
    assert velocity["rod"][2] == pytest.approx(turns, abs=1e-13)
    assert not found.misfits


def test_a_rate_that_holds_is_the_one_that_is_given_to_its_last_bit() -> None:
    angle, rate = 0.34872110387436034, -41.84473826364873  # fitted, the last bit is another one
    given = [-rate * 0.25 * np.sin(angle), rate * 0.25 * np.cos(angle)]
    start = {"angles": {"crank": angle}, "velocities": {"crank": given}}
    assert put_together(slider_crank(start))[2]["crank"][:2].tolist() == given


def test_guides_and_followers_have_rates_as_journals_have() -> None:
    _, _, velocity = put_together(ball({"guides": {"floor": {"offset": 3, "rate": -1}}}))
    assert velocity["ball"][1] == pytest.approx(-1.0, abs=1e-13)
    _, _, velocity = put_together(lever("slot", {"guides": {"stop": {"rate": 0.3}}}))
    assert velocity["lever"][2] == pytest.approx(0.3, abs=1e-13)
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "block.c", "axis": [1, 0]}
    play = {"wall_clearance": 1e-3, "length": 0.1, "height": 0.05}
    contact = {"law": "stiffness-and-dissipation", "stiffness": {"law": "power", "stiffness": 1e7}}
    contact |= {"dissipation": {"law": "exact", "restitution": 0.5}}
    document = {
        "name": "block",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {"block": {"mass": 1.0, "inertia": 0.1, "points": {"c": [0, 0]}}},
        "joints": {"guide": guide | {"clearance": play | {"contact": contact}}},
        "start": {"guides": {"guide": {"rate": 0.2, "tilt_rate": -0.5}}},
    }
    _, _, velocity = put_together(document)
    np.testing.assert_allclose(velocity["block"], [0.0, 0.2, -0.5], rtol=0, atol=1e-13)


def four_bar_at_a_dead_point(start: dict[str, Any]) -> tuple[float, dict[str, Any]]:
    """Return the crank's angle at which rod and rocker are in line, and the mechanism there."""
    crank, together, ground = 0.1, 0.25 + 0.2, 0.4
    angle = math.acos((crank**2 + ground**2 - together**2) / (2.0 * crank * ground))
    return angle, {
        "name": "four-bar",
        "ground": {"points": {"O": [0, 0], "C": [ground, 0]}},
        "bodies": {"crank": bar(0.05), "rod": bar(0.125), "rocker": bar(0.1)},
        "joints": {
            "A": revolute("ground.O", "crank.a"),
            "B": revolute("crank.b", "rod.a"),
            "C": revolute("rod.b", "rocker.b"),
            "D": revolute("ground.C", "rocker.a"),
        },
        "start": {"angles": {"crank": angle}, **start},
    }


def test_a_rate_that_a_dead_point_forbids_is_told_and_moves_nothing() -> None:
    """The crank was kept at 5 rad/s, with a rod of 5e7 rad/s: the pose is off by rounding."""
    start = {"angular_velocities": {"crank": 5.0}}
    found, _, velocity = put_together(four_bar_at_a_dead_point(start)[1])
    assert [one.pointer for one in found.misfits] == ["/start/angular_velocities/crank"]
    rest = np.array([velocity[name] for name in ("crank", "rod", "rocker")])
    np.testing.assert_allclose(rest, 0.0, rtol=0, atol=1e-6)


def test_at_a_dead_point_the_rocker_turns_rod_and_no_crank() -> None:
    """The joint of rod and rocker moves across their line, the other end of the rod rests."""
    start = {"angular_velocities": {"rocker": 5.0}}
    found, _, velocity = put_together(four_bar_at_a_dead_point(start)[1])
    assert not found.misfits
    assert velocity["rod"][2] == pytest.approx(-5.0 * 0.2 / 0.25, rel=1e-6)
    assert velocity["crank"][2] == pytest.approx(0.0, abs=1e-6)  # the pose is off by 1e-8 rad


@pytest.mark.parametrize("loose", ["B", "C", "D"])
def test_a_driver_at_a_dead_point_does_not_throw_what_play_lets_rest(loose: str) -> None:
    """Rod and rocker had 6e8 rad/s. They follow the crank's pin across their line, none faster."""
    angle, document = four_bar_at_a_dead_point({})
    play = STOPS["pin"]["clearance"] | {"radial_clearance": 1e-4, "bearing_radius": 0.01}
    document["joints"][loose]["clearance"] = play
    document["drivers"] = {"motor": {"joint": "A", "position": angle, "speed": 5.0}}
    _, pose, velocity = put_together(document)
    assert velocity["crank"][2] == pytest.approx(5.0, abs=1e-13)
    along = pose["rod"][2]
    across = np.array([-math.sin(along), math.cos(along)])
    pin = 5.0 * 0.1 * np.array([-math.sin(angle), math.cos(angle)])
    rod = velocity["rod"][:2] - 0.125 * velocity["rod"][2] * across  # its end at the crank
    assert rod @ across == pytest.approx(pin @ across, abs=1e-6)
    assert np.hypot(*velocity["rod"][:2]) <= np.hypot(*pin)
    assert np.hypot(*velocity["rocker"][:2]) <= np.hypot(*pin)
