"""Orbits of mechanisms with wheels behind gears, which are back after some turns of the drive."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.basin_scenes import ON_THE_MASS, sliding
from benchmarks.known_orbits import followed
from jointplay.local import run
from jointplay.records.branch import branches
from tests.solver.mechanics.test_gears import carrying

SPEED, STIFFNESS, DAMPING, RADIUS = 5.0, 9.0, 0.4, 0.1
"""rad/s, N/m and N s/m of 1 kg, and m of the pin on the wheel."""
TORQUE_DRAG = 2.0
"""N m s, of the inertia of both wheels: nothing is left of another speed after some turns."""


def pushed_by_a_wheel(ratio: float, *, driven: bool = True) -> dict[str, Any]:
    """Return x'' + 0.4 x' + 9 x = RADIUS cos(ratio angle): a mass that feels where a pin is.

    The pin is on a wheel behind gears. The angle of the first wheel is a driver's, or that of a
    wheel that a torque turns as fast.
    """
    push = {"type": "force", **ON_THE_MASS, "magnitude": 1.0, "direction": [1.0, 0.0]}
    push |= {"course": {"type": "polynomial", "coefficients": [0.0, 1.0]}}
    push |= {"over": {"quantity": "x", "first": "ground.B", "second": "b.pin"}}
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": STIFFNESS}
    scene = sliding("pushed-by-a-wheel", DAMPING, spring=spring, push=push)
    wheel = {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0]}}
    rim = wheel | {"points": {"O": [0.0, 0.0], "pin": [RADIUS, 0.0]}}
    pins = {
        name.upper(): {
            "type": "revolute",
            "bearing": f"ground.{name.upper()}",
            "journal": f"{name}.O",
        }
        for name in ("a", "b")
    }
    points = scene["ground"]["points"] | {"A": [0.0, 1.0], "B": [1.0, 1.0]}
    strength = {"help": "Ratio.", "unit": "1", "default": ratio}
    scene |= {
        "ground": {"points": points},
        "bodies": scene["bodies"] | {"a": wheel, "b": rim},
        "joints": scene["joints"] | pins,
        "gears": {"mesh": {"first": "A", "second": "B", "ratio": ratio}},
        "parameters": {
            "ratio": strength | {"targets": [{"path": "/gears/mesh/ratio"}]},
            "stiffness": {"help": "Spring.", "unit": "N/m", "default": STIFFNESS}
            | {"targets": [{"path": "/forces/spring/stiffness"}]},
        },
    }
    if driven:
        return scene | {"drivers": {"motor": {"joint": "A", "speed": SPEED}}}
    ends = {"first": "ground.A", "second": "a.O"}
    torque = {"type": "torque", **ends, "moment": TORQUE_DRAG * SPEED}
    drag = {"type": "torsion-spring", **ends, "damping": TORQUE_DRAG}
    forces = scene["forces"] | {"torque": torque, "drag": drag}
    return scene | {"forces": forces, "period": 2.0 * math.pi / SPEED}


def section_known(ratio: float, angle: float = 0.0) -> tuple[float, float]:
    """Return place and speed of the mass where the first wheel has turned by an angle."""
    fast = ratio * SPEED
    place = RADIUS * np.exp(1j * ratio * angle) / (STIFFNESS - fast**2 + 1j * DAMPING * fast)
    return float(place.real), float((1j * fast * place).real)


def job(scene: dict[str, Any], period: int, **others: Any) -> dict[str, Any]:
    values = {"from": STIFFNESS, "to": STIFFNESS + 1.0, "count": 2}
    return {
        "kind": "continuation",
        "scene": scene,
        "parameter": "stiffness",
        "values": values,
        "settle": 61,  # after an odd number of turns wheels may be half a turn off
        "period": period,
    } | others


@pytest.mark.parametrize(("ratio", "period"), [(0.5, 2), (-0.25, 4), (2.0, 1), (2.0 / 3.0, 3)])
def test_orbits_of_a_driven_wheel_are_those_of_the_closed_form(ratio: float, period: int) -> None:
    (branch,) = followed(job(pushed_by_a_wheel(ratio), period))
    found = [float(branch.column(f"{name}.mass.s")[0]) for name in ("state", "rate")]
    # runs err by 1e-11 of the motion at each of some hundred steps
    assert found == pytest.approx(section_known(ratio), abs=1e-9)
    size = math.hypot(
        *(float(branch.column(f"multiplier_1.{p}")[0]) for p in ("real", "imaginary"))
    )
    turn = 2.0 * math.pi / SPEED
    assert size == pytest.approx(math.exp(-0.5 * DAMPING * period * turn), abs=1e-8)
    assert float(branch.column("duration")[0]) == pytest.approx(period * turn, rel=1e-12)


@pytest.mark.parametrize(("ratio", "least"), [(0.5, 2), (0.25, 4), (2.0 / 3.0, 3)])
@pytest.mark.parametrize("driven", [True, False])
def test_where_a_wheel_is_not_back_the_reason_says_when(
    ratio: float, least: int, *, driven: bool
) -> None:
    scene = pushed_by_a_wheel(ratio, driven=driven)
    others = {} if driven else {"section": {"channel": "a.theta", "value": 1.0}}
    (branch,) = branches(run(job(scene, 1, **others), processes=1).study())
    assert branch.failure is not None
    assert f"ask for 'period' {least}," in branch.failure.detail


def test_an_orbit_of_a_wheel_that_a_torque_turns_comes_back_after_two_turns() -> None:
    ratio = 0.5
    section = {"channel": "a.theta", "value": 1.0}
    (branch,) = followed(job(pushed_by_a_wheel(ratio, driven=False), 2, section=section))
    found = [float(branch.column(f"{name}.mass.s")[0]) for name in ("state", "rate")]
    turns = float(branch.column("state.b.theta")[0]) / ratio - 1.0
    assert math.cos(turns) == pytest.approx(1.0, abs=1e-12)
    assert found == pytest.approx(section_known(ratio, turns + 1.0), abs=1e-8)


def test_a_branch_ends_where_a_ratio_lets_no_wheel_come_back() -> None:
    values = {"from": 2.0, "to": 2.2, "count": 50}
    (branch,) = followed(job(pushed_by_a_wheel(2.0), 1, parameter="ratio", values=values))
    assert branch.column("value") == pytest.approx(2.0, abs=1e-5)
    assert "a wheel behind gears is not back" in branch.special[-1].note


def with_a_bob(ratio: float) -> dict[str, Any]:
    """Return a pendulum on the rim of a wheel that a driver turns by gears; drag slows it."""
    scene = carrying()
    scene["gears"]["mesh"]["ratio"] = ratio
    ends = {"first": "ground.A", "second": "bob.R"}
    strength = {"help": "Speed.", "unit": "rad/s", "default": SPEED}
    return scene | {
        "forces": {"drag": {"type": "torsion-spring", **ends, "damping": 0.1}},
        "parameters": {"speed": strength | {"targets": [{"path": "/drivers/motor/speed"}]}},
    }


@pytest.mark.parametrize(("ratio", "period"), [(0.5, 2), (2.0, 1)])
def test_the_orbit_of_what_hangs_on_a_wheel_is_the_motion_from_its_start(
    ratio: float, period: int
) -> None:
    scene, values = with_a_bob(ratio), {"from": SPEED, "to": 6.0, "count": 1}
    asked = {"parameter": "speed", "values": values, "settle": 3}
    (branch,) = followed(job(scene, period) | asked)
    duration = 120.0 * 2.0 * math.pi / SPEED
    found = run({"kind": "simulate", "scene": scene, "duration": duration, "tolerance": 1e-11})
    angle = float(found.history["bob.theta"].values[-1])
    # 120 turns leave 0.81^120 of the start, and runs err by 1e-11 at each of some thousand steps
    assert float(branch.column("state.bob.theta")[0]) == pytest.approx(angle, abs=1e-8)


def test_a_run_begins_at_a_section_that_another_has_left_after_many_turns() -> None:
    turn, ends = 2.0 * math.pi, list[float]()
    one = {"kind": "simulate", "scene": with_a_bob(2.0), "duration": turn / SPEED}
    for turns in (0, 30):
        state = [turns * turn, 0.1, 2.0 * SPEED, 0.0]
        history = run(one | {"tolerance": 1e-10, "state": state}).history
        ends.append(float(history["bob.theta"].values[-1]))
    # 30 turns round off by 3e-14
    assert ends[1] == pytest.approx(ends[0], abs=1e-9)
