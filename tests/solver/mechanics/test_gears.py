"""Gears: closed forms of trains, both formulations, and what is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from tests.solver.completed_runs import run
from tests.solver.random_mechanisms import near_start
from tests.solver.readable_mechanics import Instant, scene_of

RATIO, TORQUE, INERTIAS = -2.5, 3.0, (0.02, 0.05)


def pin(bearing: str, journal: str) -> dict[str, Any]:
    return {"type": "revolute", "bearing": bearing, "journal": journal}


def wheel(inertia: float) -> dict[str, Any]:
    return {"mass": 1.0, "inertia": inertia, "points": {"O": [0.0, 0.0]}}


def train(**changes: Any) -> dict[str, Any]:
    """Return a wheel that a torque turns, and another that it drives."""
    torque = {"type": "torque", "first": "ground.A", "second": "a.O", "moment": TORQUE}
    scene = {
        "name": "train",
        "ground": {"points": {"A": [0.0, 0.0], "B": [0.3, 0.0]}},
        "bodies": {"a": wheel(INERTIAS[0]), "b": wheel(INERTIAS[1])},
        "joints": {"A": pin("ground.A", "a.O"), "B": pin("ground.B", "b.O")},
        "gears": {"mesh": {"first": "A", "second": "B", "ratio": RATIO}},
        "forces": {"motor": torque},
    }
    return scene | changes


def epicyclic() -> dict[str, Any]:
    """Return an arm that swings under gravity, with a planet that rolls about a fixed sun."""
    planet = {"mass": 2.0, "inertia": 0.01, "points": {"P": [0.03, 0.0]}}
    return {
        "name": "epicyclic",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "arm": {"mass": 1.0, "inertia": 0.02, "points": {"O": [-0.1, 0.0], "P": [0.2, 0.0]}},
            "planet": planet,
        },
        "joints": {"O": pin("ground.O", "arm.O"), "P": pin("arm.P", "planet.P")},
        # a sun of radius 0.2 m and a planet of 0.1 m: the planet turns by 2 more in the arm
        "gears": {"mesh": {"first": "O", "second": "P", "ratio": 2.0, "offset": 0.3}},
        "start": {"angles": {"arm": 0.2, "planet": 0.9}},
    }


def meshing(instant: Instant) -> Instant:
    """Return an epicyclic train whose planet stands and turns as the gear has it."""
    q, v = dict(instant.position), dict(instant.speed)
    q["planet.theta"], v["planet.theta"] = 3.0 * q["arm.theta"] + 0.3, 3.0 * v["arm.theta"]
    return replace(instant, position=q, speed=v)


@settings(max_examples=25)
@given(near_start(scene_of(epicyclic()), 1.0).map(meshing))
def test_a_planet_turns_with_its_arm_by_the_gears_moment(instant: Instant) -> None:
    one, two = instant.reduced(), instant.lagrange()
    arm, planet = one.bodies["arm"], one.bodies["planet"]
    assert planet.angular_acceleration == pytest.approx(3.0 * arm.angular_acceleration, rel=1e-12)
    for name, body in one.bodies.items():
        np.testing.assert_allclose(body.acceleration, two.bodies[name].acceleration, rtol=1e-9)
    assert one.held_moment["mesh"] == pytest.approx(two.held_moment["mesh"], rel=1e-9, abs=1e-9)
    # the planet by Newton and Euler about its centre: the pin's force at its arm, and the gear
    c, s = np.cos(planet.angle), np.sin(planet.angle)
    fx, fy = one.joint_force["P"]
    pin_moment = 0.03 * (c * fy - s * fx)
    expected = 0.01 * planet.angular_acceleration - pin_moment
    assert one.held_moment["mesh"] == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_a_torque_speeds_both_wheels_up_as_one_inertia() -> None:
    found = run(train(), 2.0, output_step=0.1)
    acceleration = TORQUE / (INERTIAS[0] + RATIO**2 * INERTIAS[1])
    # 18 rad after 2 s
    np.testing.assert_allclose(found["a.theta"], 0.5 * acceleration * found.time**2, atol=1e-9)
    np.testing.assert_allclose(found["b.theta"], RATIO * found["a.theta"], atol=1e-9)
    np.testing.assert_allclose(found["mesh.moment"], INERTIAS[1] * RATIO * acceleration, rtol=1e-9)
    ledger = found.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-6 * ledger["gross_work"]


def carrying() -> dict[str, Any]:
    """Return a train whose first wheel a motor turns; from the second's rim hangs a pendulum."""
    rim = wheel(INERTIAS[1]) | {"points": {"O": [0.0, 0.0], "R": [0.1, 0.0]}}
    bob = {"mass": 0.5, "inertia": 1e-3, "points": {"R": [0.0, 0.2]}}
    scene = train(drivers={"motor": {"joint": "A", "speed": 5.0}}, forces={})
    scene["bodies"] |= {"b": rim, "bob": bob}
    scene["joints"]["R"] = pin("b.R", "bob.R")
    return scene | {"gravity": [0.0, -9.81]}


def test_a_driven_wheel_turns_another_for_many_turns_and_feels_its_load() -> None:
    one, two = (
        run(carrying(), 3.0, tolerance=1e-9, output_step=0.05, formulation=formulation)
        for formulation in ("reduced", "lagrange")
    )
    np.testing.assert_allclose(one["a.theta"], 5.0 * one.time, atol=1e-12)
    # six turns of the second wheel, as many whole ones as the first's and more
    np.testing.assert_allclose(one["b.theta"], RATIO * 5.0 * one.time, atol=1e-9)
    for channel in ("bob.theta", "motor.torque", "mesh.moment", "B.force_y"):
        tiny = 1e-6 * np.ptp(one[channel])
        np.testing.assert_allclose(one[channel], two[channel], rtol=0.0, atol=tiny)
    # the motor's torque is that of the gear, -ratio times as large: the wheels turn steadily
    np.testing.assert_allclose(one["motor.torque"], RATIO * one["mesh.moment"], atol=1e-9)
    ledger = one.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-9 * ledger["gross_work"]


def test_a_driven_train_with_nothing_else_to_move_is_followed_for_many_turns() -> None:
    drivers = {"motor": {"joint": "A", "speed": 5.0}}
    found = run(train(drivers=drivers, forces={}), 30.0, output_step=0.1)
    # 24 turns of the first wheel, 60 of the second: rounding of 375 rad
    np.testing.assert_allclose(found["b.theta"], RATIO * 5.0 * found.time, rtol=0.0, atol=1e-12)
    assert found.peaks["b.theta"].minimum == pytest.approx(30.0 * RATIO * 5.0, rel=1e-14)
    turn = 2.0 * np.pi / 5.0
    np.testing.assert_allclose(found.section_time, turn * np.arange(24), rtol=1e-15)
    np.testing.assert_allclose(found.sections["b.theta"], RATIO * 5.0 * found.section_time)


def test_a_train_that_swings_as_driven_needs_the_torque_of_both_inertias() -> None:
    motion = {"type": "sinusoidal", "amplitude": 9.0, "frequency": 2.0}
    found = run(train(drivers={"motor": {"joint": "A", "motion": motion}}, forces={}), 3.0)
    both = INERTIAS[0] + RATIO**2 * INERTIAS[1]
    np.testing.assert_allclose(found["motor.torque"], both * found["a.alpha"], atol=1e-12)
    np.testing.assert_allclose(found["mesh.moment"], INERTIAS[1] * found["b.alpha"], atol=1e-12)


@pytest.mark.long
def test_a_planet_that_swings_keeps_its_energy() -> None:
    for formulation in ("reduced", "lagrange"):
        ledger = run(epicyclic(), 3.0, formulation=formulation).statistics["energy"]
        assert abs(ledger["residual"]) <= 10.0 * 1e-6 * ledger["gross_work"]


MESH = {"first": "A", "second": "B", "ratio": RATIO}
GUIDE = {"type": "prismatic", "guide": "ground.B", "slider": "b.O", "axis": [1.0, 0.0]}
BAD: dict[str, tuple[dict[str, Any], str, str]] = {
    "no such joint": (
        {"gears": {"mesh": MESH | {"second": "C"}}},
        "/gears/mesh/second",
        "no joint",
    ),
    "one joint": ({"gears": {"mesh": MESH | {"second": "A"}}}, "/gears/mesh/second", "two joints"),
    "no ratio": ({"gears": {"mesh": MESH | {"ratio": 0.0}}}, "/gears/mesh/ratio", "stand still"),
    "bodies that do not turn": (
        {"joints": {"A": pin("ground.A", "a.O"), "B": GUIDE}},
        "/gears/mesh/second",
        "do not turn against each other: it is prismatic",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_gear_is_refused(case: str) -> None:
    changes, pointer, words = BAD[case]
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": train(**changes), "duration": 1.0})
    found = {problem.pointer: problem.detail for problem in refused.value.problems}
    assert words in found[f"/scene{pointer}"]
