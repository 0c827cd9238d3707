"""Orbits of mechanisms that nothing drives: sections are where a channel crosses a value."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from benchmarks.basin_scenes import pendulum, sliding
from benchmarks.known_orbits import followed
from benchmarks.limit_cycles import SHARP, SPRING, VAN_DER_POL, over_speed, rayleigh, varied
from jointplay.local import run
from jointplay.records.branch import Branch, branches

SECTION = {"channel": "mass.x", "value": 0.0}
JOB: dict[str, Any] = {"parameter": "strength", "section": SECTION, "state": [0.0, 1.0]}
GAP, RESTITUTION, PUSH, STOP = 0.1, 0.5, 0.2, 1e11
"""m, 1, N s/m of a push, and N/m^1.5 of the stop; of 1 kg on a spring of 1 N/m."""
TURNING = {
    "scene": pendulum(),
    "parameter": "push",
    "section": {"channel": "rod.theta", "value": 1.0},
    "state": [0.0, 5.0],
    "settle": 60,
}


def striking() -> dict[str, Any]:
    """Return a mass that its speed pushes on until it strikes a stop, once a period."""
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": STOP, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": RESTITUTION},
    }
    scene = sliding("striking", 1e-13, spring=SPRING, push=over_speed([0.0, PUSH]))
    stop = {"type": "revolute", "bearing": "ground.stop", "journal": "mass.centre"}
    room = {"radial_clearance": 1.0, "bearing_radius": 2.0, "contact": contact}
    scene["joints"] = scene["joints"] | {"stop": stop | {"clearance": room}}
    scene["ground"] = {"points": scene["ground"]["points"] | {"stop": [GAP - 1.0, 0.0]}}
    scene["start"] = {"joints": {"stop": {"eccentricity": [1.0 - GAP, 0.0]}}}
    return varied(scene, "/forces/push/magnitude", 1.0)


def striking_once() -> tuple[float, float]:
    """Return the period between impacts on a rigid stop, s, and the speed before each, m/s.

    In closed form: the speed to come back with is that which leaves, the share e of it.
    """
    growth = PUSH / 2.0
    turning = math.sqrt(1.0 - growth**2)

    def at(t: float, speed: float) -> tuple[float, float]:
        e, c, s = math.exp(growth * t), math.cos(turning * t), math.sin(turning * t)
        b = (-RESTITUTION * speed - growth * GAP) / turning
        x = e * (GAP * c + b * s)
        return x, growth * x + turning * e * (b * c - GAP * s)

    def away(t: float) -> float:
        # place is linear in the speed, which brings it back to the gap at that time
        none, one = at(t, 0.0)[0], at(t, 1.0)[0]
        speed = (GAP - none) / (one - none)
        return at(t, speed)[1] - speed

    period = brentq(away, 3.3, 5.0, xtol=1e-13)
    none, one = at(period, 0.0)[0], at(period, 1.0)[0]
    return period, (GAP - none) / (one - none)


def found(job: dict[str, Any]) -> Branch:
    (branch,) = followed(job)
    return branch


def refusal(job: dict[str, Any]) -> str:
    (branch,) = branches(run({"kind": "continuation"} | job, processes=1).study())
    assert branch.failure is not None
    return branch.failure.detail


def test_the_period_is_that_of_van_der_pols_oscillator_and_one_multiplier_is_left() -> None:
    values = {"from": 1.0, "to": 1.01, "count": 1}
    branch = found(JOB | {"scene": rayleigh(), "values": values, "settle": 30})
    assert branch.column("duration")[0] == pytest.approx(VAN_DER_POL, abs=1e-10)
    names = [channel.name for channel in branch.columns]
    assert "multiplier_1.real" in names
    assert "multiplier_2.real" not in names
    # the multiplier is that of Liouville's formula along the motion by another integrator
    state = [float(branch.column(f"{kind}.mass.s")[0]) for kind in ("state", "rate")]
    motion = solve_ivp(
        lambda _t, y: [y[1], y[1] - y[1] ** 3 / 3.0 - y[0], 1.0 - y[1] ** 2],
        (0.0, VAN_DER_POL),
        [*state, 0.0],
        **SHARP,
    )
    multiplier = math.exp(motion.y[2, -1])
    error = abs(float(branch.column("multiplier_1.real")[0]) - multiplier)
    assert error < branch.column("multiplier_error")[0] + 1e-8


def test_a_pendulum_that_goes_round_is_damped_as_its_period_says() -> None:
    branch = found(TURNING | {"values": {"from": 0.5, "to": 0.4, "count": 8}})
    period, multiplier = branch.column("duration"), branch.column("multiplier_1.real")
    assert len(period) == 9
    # the noise of runs, 1e-11, by the step of differences, 1e-5
    assert multiplier == pytest.approx(np.exp(-0.1 * period), abs=1e-6)
    angle, rate = branch.column("state.rod.theta"), branch.column("rate.rod.theta")
    # Newton's method ends at ten times the tolerance of runs, 1e-11
    assert np.cos(angle) == pytest.approx(np.full(9, math.cos(1.0)), abs=1e-10)
    motion = solve_ivp(
        lambda angle, y: [(0.5 - math.sin(angle)) / y[0] - 0.1],
        (angle[0], angle[0] + 2.0 * math.pi),
        [rate[0]],
        dense_output=True,
        **SHARP,
    )
    assert motion.y[0, -1] == pytest.approx(rate[0], abs=1e-9)
    known, _ = quad(lambda a: 1.0 / motion.sol(a)[0], angle[0], angle[0] + 2.0 * math.pi)
    assert period[0] == pytest.approx(known, abs=1e-9)


def test_an_impact_right_behind_the_section_counts_once() -> None:
    section = SECTION | {"value": GAP - 1e-4}
    job = JOB | {"section": section, "state": [0.05, 0.3], "settle": 60}
    branch = found(job | {"scene": striking(), "values": {"from": 1.0, "to": 1.1, "count": 6}})
    assert set(branch.column("impacts").tolist()) == {1.0}
    period, speed = striking_once()
    # a contact of 1e11 N/m^1.5 lasts some 1e-4 s
    assert branch.column("duration")[0] == pytest.approx(period, abs=1e-3)
    assert branch.column("rate.mass.s")[0] == pytest.approx(speed, abs=1e-3)


def test_what_winds_up_is_no_orbit_though_its_speed_comes_back() -> None:
    scene = pendulum() | {"gravity": [0.0, 0.0]}
    drag = scene["forces"]["drag"] | {"stiffness": 0.01}
    scene["forces"] = scene["forces"] | {"drag": drag}
    values = {"from": 0.5, "to": 0.6, "count": 2}
    job = TURNING | {"scene": scene, "values": values, "settle": 0, "state": [0.9, 4.0]}
    assert "winds up" in refusal(job)


def test_a_motion_that_comes_to_rest_is_not_waited_for() -> None:
    values = {"from": 0.05, "to": 0.1, "count": 2}
    detail = refusal(TURNING | {"values": values})
    assert "The motion is at the section 0 instead of 2 times until" in detail


def test_orbits_without_losses_are_a_family_and_no_branch() -> None:
    section = {"channel": "rod.theta", "value": -1.57}
    values = {"from": 1.0, "to": 2.0, "count": 3}
    job = {"scene": {"preset": "pendulum"}, "parameter": "mass", "values": values}
    for orbits in (1, 2):
        several = run(
            {"kind": "continuation"} | job | {"section": section, "orbits": orbits}, processes=1
        )
        for one in branches(several.study()):
            assert one.failure is not None
            assert "one for each energy" in one.failure.detail


def test_a_branch_ends_where_its_orbit_comes_to_rest_upside_down() -> None:
    values = {"from": 0.2, "to": 0.1, "count": 60}
    branch = found(TURNING | {"values": values, "largest_step": 0.2})
    last = branch.special[-1]
    assert last.label == "MX"
    assert last.value == pytest.approx(0.12700885981, abs=1e-7)  # see `benchmarks limit_cycles`
    assert "its period grows as next to a position of rest" in last.note
    assert not [one for one in branch.special if one.label not in ("EP", "MX")]
