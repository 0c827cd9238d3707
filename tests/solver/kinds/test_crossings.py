"""A section that a channel never crosses is refused; one that it does cross is not."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.runs.ideal.reach import MotionReach
from tests.solver.cams import CIRCLE, follower, valve
from tests.solver.completed_runs import CASE_3, run
from tests.solver.runs.study.jobs_of_studies import BIFURCATION, POINCARE, study

NEVER: dict[str, tuple[dict[str, Any], str, str]] = {
    "far beyond the slider's stroke": (
        {"channel": "slider7.x", "value": 5.0},
        "/section/value",
        "stays between 1.4",
    ),
    "an output beyond the stroke, in its own terms": (
        {"channel": "displacement", "value": 0.6},
        "/section/value",
        "'displacement' never crosses 0.6 m: it stays between -0.01",
    ),
    "a link's angle beyond its swing": (
        {"channel": "link3.theta", "value": 0.5},
        "/section/value",
        "rad",
    ),
    "across the guide": (
        {"channel": "slider7.y", "value": 0.0},
        "/section/channel",
        "does not change",
    ),
    "the constant speed of a crank": (
        {"channel": "crank1.omega", "value": 3.0},
        "/section/channel",
        "does not change",
    ),
    "a driven body's speed beyond its own": (
        {"channel": "crank1.vx", "value": 1.0},
        "/section/value",
        "m/s",
    ),
    "far outside the bearing": (
        {"channel": "A.eccentricity_x", "value": 5.01e-3},
        "/section/value",
        "radial clearance of 0.0005 m in a bearing of radius 0.005 m",
    ),
    "deeper than the bearing's centre": (
        {"channel": "A.penetration", "value": -6e-4},
        "/section/value",
        "between -0.0005 and 0.0045 m",
    ),
    "a pulling contact": (
        {"channel": "A.normal_force", "value": -1.0},
        "/section/value",
        "never below zero",
    ),
    "an angle of so many turns that none is told from the next": (
        {"channel": "crank1.theta", "value": 1e300},
        "/section/value",
        "between -1e+06 and 1e+06 rad",
    ),
    "no kinetic energy": (
        {"channel": "energy.kinetic", "value": -1.0},
        "/section/value",
        "never below zero",
    ),
}


@pytest.mark.parametrize("case", NEVER)
def test_a_section_that_is_never_crossed_is_refused(case: str) -> None:
    section, pointer, words = NEVER[case]
    with pytest.raises(InvalidInput) as refused:
        admit({**POINCARE, "section": section})
    found = {problem.pointer: problem.detail for problem in refused.value.problems}
    assert words in found[pointer], found


@pytest.mark.parametrize(
    "section",
    [
        {"channel": "slider7.x", "value": 1.7},
        {"channel": "displacement", "value": 0.2, "direction": "down"},
        {"channel": "slider7.vx", "value": 100.0},  # an impact may throw the slider
        {"channel": "crank1.vx", "value": 0.1},
        {"channel": "crank1.theta", "value": 1.0},  # once a turn
        {"channel": "A.eccentricity_x", "value": 4e-4},
        {"channel": "A.penetration", "value": 0.0},
        {"channel": "A.normal_force", "value": 10.0},
        {"channel": "A.slip_velocity", "value": 0.0},
        {"channel": "drive1.torque", "value": 0.0},
    ],
)
def test_a_section_that_may_be_crossed_is_admitted(section: dict[str, Any]) -> None:
    assert study(POINCARE, section=section).job["section"]["channel"] == section["channel"]


def test_the_value_whose_clearance_is_too_small_for_a_section_is_named() -> None:
    section = {"channel": "A.penetration", "value": -1.5e-4}
    with pytest.raises(InvalidInput) as refused:
        admit({**BIFURCATION, "section": section, "values": [5e-4, 2e-4, 1e-4]})
    assert "Value 2 (clearance = 0.0001 m)" in refused.value.problems[0].detail


def test_a_journal_in_a_soft_contact_goes_deeper_than_its_clearance() -> None:
    contact = {"law": "lankarani-nikravesh", "stiffness": 1e5, "restitution": 1.0}
    play = {"radial_clearance": 1e-4, "bearing_radius": 0.02, "contact": contact}
    scene: dict[str, Any] = {
        "name": "soft",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {"disc": {"mass": 1.0, "inertia": 1e-3, "points": {"c": [0, 0]}}},
        "joints": {
            "pin": {"type": "revolute", "bearing": "ground.O", "journal": "disc.c"}
            | {"clearance": play}
        },
        "start": {"joints": {"pin": {"rate": [1.0, 0.0]}}},
    }
    deepest = (1.25 / 1e5) ** 0.4  # m v^2 / 2 = 2/5 K depth^2.5: 109 clearances
    depth = run(scene, 0.04).peaks["pin.penetration"].maximum
    assert depth == pytest.approx(deepest, rel=1e-4)
    section = {"channel": "pin.penetration", "value": 2e-3}
    asked = study(POINCARE, scene=scene, section=section)
    assert asked.job["section"]["channel"] == "pin.penetration"


def test_a_follower_that_lifts_off_may_be_anywhere() -> None:
    scene = valve(follower("flat", CIRCLE, lash=1e-4))
    scene["drivers"]["motor"]["speed"] = 400.0  # the valve floats
    scene["start"]["points"]["tappet.F"] = [0.0, 0.02]
    assert run(scene, 0.1, output_step=1e-3).peaks["tappet.y"].maximum > 0.1  # the cam: 0.06
    section = {"channel": "tappet.y", "value": 0.1}
    assert study(POINCARE, scene=scene, section=section).job["section"] == section | {
        "direction": "up"
    }


def test_a_mechanism_that_moves_freely_may_cross_anything() -> None:
    scene = {"preset": "pendulum"}
    assert study(POINCARE, scene=scene, section={"channel": "rod.theta", "value": 3.0})


def test_a_run_with_play_stays_within_the_reach_of_its_bodies() -> None:
    tight = CASE_3 | {"bearing_radius": 1.5e-3}
    found = run("seven-bar-press", 2.0, parameters=tight, output_step=1e-3)
    scene = found.admission.scene
    assert found.admission.period is not None
    reach = MotionReach(scene, found.admission.period)
    for body in scene.bodies:
        for quantity in ("x", "y", "theta"):
            bounds = reach.of(body, quantity)
            assert bounds is not None
            samples = found[f"{body}.{quantity}"]
            slack = 1e-9  # m and rad, of the integration
            assert bounds.low - slack <= samples.min(), (body, quantity)
            assert samples.max() <= bounds.high + slack, (body, quantity)
            spread = np.ptp(samples)
            # no wider than it need be: play moves this mechanism by a few clearances
            assert bounds.high - bounds.low <= 1.05 * spread + 0.02, (body, quantity)
