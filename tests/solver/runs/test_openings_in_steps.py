"""A gap that opens and closes again within one step ends a contact, and begins another one.

The named runs have truths that an independent integration in absolute coordinates gives to 1e-12.
"""

from typing import Any

import numpy as np
import pytest

from benchmarks.openings.runs import Ran, run
from benchmarks.openings.search import SETTINGS, Searched, search, soft_contacts

AJAR = 1e-11
"""A gap inside a contact, m, that is more than rounding."""


def rotor(
    accuracy: str,
    duration: float,
    gravity: float,
    body: dict[str, Any],
    clearance: dict[str, Any],
    spin: float,
    velocity: list[float],
    eccentricity: list[float],
) -> Ran:
    """Run a rotor in a soft bearing."""
    start = {
        "angles": {"rotor": 0.0},
        "angular_velocities": {"rotor": spin},
        "velocities": {"rotor": velocity},
        "joints": {"J": {"eccentricity": eccentricity}},
    }
    joint = {"type": "revolute", "bearing": "ground.O", "journal": "rotor.centre"}
    scene = {
        "name": "rotor",
        "gravity": [0.0, gravity],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rotor": body},
        "joints": {"J": joint | {"clearance": clearance}},
        "start": start,
    }
    job = {"kind": "simulate", "scene": scene, "duration": duration, "accuracy": accuracy}
    (found,) = run([job])
    assert found.done
    assert found.open_in_contact <= AJAR
    return found


def bearing(
    clearance: float, radius: float, stiffness: float, restitution: float, friction: list[float]
) -> dict[str, Any]:
    coefficient, static, dynamic = friction
    return {
        "radial_clearance": clearance,
        "bearing_radius": radius,
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": stiffness,
            "restitution": restitution,
        },
        "friction": {
            "law": "modified-coulomb",
            "coefficient": coefficient,
            "static_velocity": static,
            "dynamic_velocity": dynamic,
        },
    }


BODY = {
    "mass": 0.0741421572,
    "inertia": 0.000488013299,
    "points": {"centre": [6.823449367368493e-06, 0.0]},
}
FIT = 8.85376701e-06, 0.0003788514773918196
RUBBED = [0.00502963285, 0.00888154835, 0.0177630967]
BESIDE = [2.5070297005396515e-06, -5.552383353884716e-07]


def test_an_opening_of_a_hundredth_of_a_millisecond_ends_a_contact() -> None:
    clearance = bearing(*FIT, 658801.8523259438, 0.9613399780162026, RUBBED)
    velocity = [0.1967268209656814, 0.26217597626448336]
    turning = -100.36622930001788
    found = rotor("standard", 0.05, -9.81, BODY, clearance, turning, velocity, BESIDE)
    assert len(found.onset) == 2
    assert found.release[0] == pytest.approx(0.0135618061, abs=2e-8)
    assert found.onset[1] == pytest.approx(0.0135774843, abs=2e-8)
    assert found.rate[1] == pytest.approx(0.0813181460, rel=5e-4)
    assert np.isinf(found.release[1])


def test_a_draft_sees_the_same_kind_of_opening() -> None:
    clearance = bearing(*FIT, 587999.566, 0.949182398, RUBBED)
    velocity = [0.210293321, 0.254745505]
    found = rotor("draft", 0.0155991268, -9.81, BODY, clearance, -77.7361467, velocity, BESIDE)
    assert len(found.onset) == 2
    assert found.onset[1] == pytest.approx(0.0142203440, abs=5e-6)


def test_a_draft_sees_the_first_of_seven_openings() -> None:
    body = {
        "mass": 0.0590986745,
        "inertia": 2.50920071e-05,
        "points": {"centre": [1.3371153578471877e-06, 0.0]},
    }
    friction = [0.0270009943, 0.00230888358, 0.00461776716]
    clearance = bearing(7.17386055e-06, 0.00032216340532090313, 15427954.9, 1.0, friction)
    velocity, beside = (
        [-0.285499701, 0.169958205],
        [-2.4290627185816446e-06, -2.6152683254022923e-06],
    )
    found = rotor("draft", 0.0113668374, 0.0, body, clearance, 1.1914834, velocity, beside)
    assert len(found.onset) == 7
    assert found.release[0] == pytest.approx(0.00174378836, abs=1e-6)
    assert found.onset[1] == pytest.approx(0.00178649521, abs=1e-6)


def check(found: list[Searched]) -> None:
    """Nothing is missed, nothing made up, and no gap is open inside a contact."""
    assert all(each.ended == "judged" for each in found)
    assert [each.job for each in found if each.judgement.missed] == []
    assert [each.job for each in found if each.judgement.made_up] == []
    assert max(each.ajar for each in found) <= AJAR


def test_no_opening_of_twenty_soft_contacts_is_missed() -> None:
    found = list(search(soft_contacts(3, 20), ["draft", "standard", "fine", "reference"]))
    check(found)
    assert sum(each.judgement.judged for each in found) > 200


@pytest.mark.long
def test_no_opening_of_a_thousand_soft_contacts_is_missed() -> None:
    found = list(search(soft_contacts(1, 1000), SETTINGS))
    check(found)
    assert sum(each.judgement.judged for each in found) > 18_000
