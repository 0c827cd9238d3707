"""A motor, a torsion spring and varying forces at work: closed forms, SciPy, ledger."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from tests.solver.completed_runs import Run, run
from tests.solver.driven_motions import function
from tests.solver.runs.study.test_run import Computed

SINE = {"type": "sinusoidal", "amplitude": 1.0, "frequency": 3.0}
INERTIA, STALL, NO_LOAD = 0.02, 1.5, 60.0
STIFFNESS, MASS, FORCE = 0.8, 2.0, 5.0
PRESS = {
    "type": "table",
    "knots": [-0.4, -0.2, -0.1, 0.0],
    "values": [1.0, 0.9, 0.3, 0.0],
    "between": "monotone",
    "outside": "held",
}


def workshop() -> dict[str, Any]:
    """Return a motor with a flywheel, a wheel on a coil, a shaken block, a ram that presses."""
    wheel = {"mass": 1.0, "inertia": INERTIA, "points": {"O": [0.0, 0.0]}}
    block = {"mass": MASS, "inertia": 1.0, "points": {"O": [0.0, 0.0]}}

    def pin(body: str) -> dict[str, Any]:
        return {"type": "revolute", "bearing": "ground.O", "journal": f"{body}.O"}

    def slide(body: str, axis: list[float]) -> dict[str, Any]:
        ends = {"guide": "ground.O", "slider": f"{body}.O"}
        return {"type": "prismatic", "axis": axis} | ends

    def on(body: str) -> dict[str, str]:
        return {"first": "ground.O", "second": f"{body}.O"}

    return {
        "name": "workshop",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rotor": wheel, "balance": wheel, "block": block, "ram": block},
        "joints": {
            "a": pin("rotor"),
            "b": pin("balance"),
            "c": slide("block", [1.0, 0.0]),
            "d": slide("ram", [0.0, 1.0]),
        },
        "forces": {
            "motor": {"type": "motor", "stall_torque": STALL, "no_load_speed": NO_LOAD}
            | on("rotor"),
            "coil": {"type": "torsion-spring", "stiffness": STIFFNESS, "free_angle": 0.3}
            | on("balance"),
            "shaker": {"type": "force", "magnitude": FORCE, "direction": [2.0, 0.0]}
            | {"course": SINE}
            | on("block"),
            "spring": {"type": "force", "magnitude": 120.0, "direction": [0.0, 1.0]}
            | {"course": {"type": "polynomial", "coefficients": [0.0, -1.0]}}
            | {"over": {"quantity": "y"}}
            | on("ram"),
            "punch": {"type": "force", "magnitude": 40.0, "direction": [0.0, 1.0]}
            | {"course": PRESS, "over": {"quantity": "y"}, "only": "falling", "full_rate": 0.1}
            | on("ram"),
        },
    }


@pytest.fixture(scope="module")
def working() -> Run:
    return run(workshop(), 3.0, tolerance=1e-9, output_step=0.05)


def test_a_motor_brings_its_flywheel_to_its_speed_without_load(working: Run) -> None:
    fading = np.exp(-working.time * STALL / (INERTIA * NO_LOAD))
    # tolerance 1e-9 a step of local error, relative to some 60 rad/s, over some thousand steps
    np.testing.assert_allclose(working["rotor.omega"], NO_LOAD * (1.0 - fading), atol=1e-5)
    np.testing.assert_allclose(working["motor.moment"], STALL * fading, atol=1e-6)


def test_sections_of_the_motors_angle_are_taken_once_a_turn() -> None:
    section = {"channel": "rotor.theta", "value": 0.5, "direction": "up"}
    job = {"kind": "poincare", "scene": workshop(), "settle": 0, "record": 12, "section": section}
    found = Computed({**job, "observables": ["rotor.theta", "rotor.omega"]}).sections(0)
    turns = (found[:, 0] - 0.5) / (2.0 * np.pi)
    np.testing.assert_allclose(turns, np.arange(12), atol=1e-6)
    assert np.all(np.diff(found[:, 1]) > 0.0)


def test_a_torsion_spring_swings_its_wheel(working: Run) -> None:
    swing = 0.3 * (1.0 - np.cos(np.sqrt(STIFFNESS / INERTIA) * working.time))
    np.testing.assert_allclose(working["balance.theta"], swing, atol=1e-6)
    np.testing.assert_allclose(working["coil.moment"], STIFFNESS * (0.3 - swing), atol=1e-6)


def test_a_force_of_time_shakes_its_block(working: Run) -> None:
    t, w = working.time, 3.0
    expected = FORCE / MASS * (t / w - np.sin(w * t) / w**2)
    np.testing.assert_allclose(working["block.x"], expected, atol=1e-6)


def test_a_punch_presses_on_the_way_down_alone(working: Run) -> None:
    course = function(PRESS)

    def slope(_t: float, state: np.ndarray) -> list[float]:
        y, v = state
        share = min(max(-v / 0.1, 0.0), 1.0)
        punch = 40.0 * course.at(float(y)).value * share * share * (3.0 - 2.0 * share)
        return [v, -9.81 + (punch - 120.0 * y) / MASS]

    found = solve_ivp(slope, (0.0, 3.0), [0.0, 0.0], "DOP853", working.time, rtol=1e-11, atol=1e-13)
    # both integrators pass the kinks of the table and of the gate within their own errors
    np.testing.assert_allclose(working["ram.y"], found.y[0], atol=1e-6)
    assert working["punch.force"].max() > 5.0
    assert np.all(working["punch.force"][working["ram.vy"] > 0.0] == 0.0)


def test_works_of_all_elements_are_in_the_ledger(working: Run) -> None:
    energy = working.statistics["energy"]
    assert abs(energy["residual"]) <= 1e-6 * energy["gross_work"]
    twist = working["balance.theta"][-1] - 0.3
    change = 0.5 * STIFFNESS * (twist**2 - 0.3**2)
    assert energy["stored_change"] == pytest.approx(change, abs=1e-7)


def test_a_motor_that_drives_against_its_speed_is_refused() -> None:
    scene = workshop()
    scene["forces"]["motor"]["no_load_speed"] = -60.0
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/forces/motor/no_load_speed"
    assert "one sign" in problem.detail
