"""Slow impacts: restitution holds far below 1 mm/s, and what is below the floor is told."""

from typing import Any

import numpy as np
import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.impact_floors import MOST, impact_floor, resting_rate, scene_speed
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene.pairs import contact_pairs
from tests.solver.readable_mechanics import scene_of

LASH = 1e-4


def stop(speed: float, asked: float = 0.5, law: str = "exact", **own: Any) -> dict[str, Any]:
    """Return a disc that slides towards a stop at a speed, m/s, without gravity."""
    dissipation = {"law": law, "restitution": asked} | own
    contact = {"law": "stiffness-and-dissipation", "dissipation": dissipation}
    contact["stiffness"] = {"law": "power", "stiffness": 1e9}
    play = {"lash": LASH, "contact": contact}
    profile = {"type": "constant", "value": 2e-4}
    face = {"type": "flat-follower", "cam": "disc.c", "follower": "ground.S", "normal": [1.0, 0.0]}
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "disc.c", "axis": [1.0, 0.0]}
    return {
        "name": "stop",
        "ground": {"points": {"O": [0.0, 0.0], "S": [0.01, 0.0]}},
        "bodies": {"disc": {"mass": 0.1, "inertia": 1e-5, "points": {"c": [0.0, 0.0]}}},
        "joints": {"guide": guide, "stop": face | {"profile": profile, "clearance": play}},
        "start": {"guides": {"stop": {"offset": 1e-5}}, "velocities": {"disc": [speed, 0.0]}},
    }


def ended(scene: dict[str, Any], duration: float) -> tuple[float, dict[str, Any]]:
    """Return the speed at the end, m/s, and what the certificate says."""
    job = {"kind": "simulate", "scene": scene, "duration": duration}
    simulation = Simulation(admit(job | {"tolerance": 1e-7, "output_step": duration}))
    speed = [piece.samples for piece in simulation.slices() if len(piece.samples)][-1]
    channel = [one.name for one in simulation.admission.channels].index("disc.vx")
    certificate = simulation.certificate()
    assert certificate is not None
    return float(speed[-1, channel]), certificate.facts


@pytest.mark.parametrize("speed", [1e-2, 1e-4, 1e-5])
def test_what_is_asked_is_delivered_however_slow_the_impact(speed: float) -> None:
    back, facts = ended(stop(speed), 4.0 * LASH / speed)
    assert -back / speed == pytest.approx(0.5, abs=1e-4)
    assert facts["slow_impacts"] == 0
    assert "impact_rate_floor" not in facts["note"]


def test_a_speed_that_is_given_of_the_joint_counts_as_one_of_its_body() -> None:
    scene = stop(0.0)
    scene["start"] = {"guides": {"stop": {"offset": 1e-5, "rate": -1e-4}}}
    assert scales(scene) == pytest.approx((1e-4, 1e-9, 1e-4))
    back, facts = ended(scene, 4.0)
    assert back == pytest.approx(-0.5e-4, abs=1e-8)
    assert facts["slow_impacts"] == 0


@pytest.mark.parametrize("half", [1e-4, 1e-6])
def test_a_driver_that_starts_from_rest_is_as_fast_as_it_crosses_the_play(half: float) -> None:
    """It moves half t^2 m towards a disc at rest, which leaves it with half of its speed more."""
    scene, gap = stop(0.0), 1.1e-4
    motion = {"type": "polynomial", "coefficients": [0.0, 0.0, -half]}
    slide = {"type": "prismatic", "guide": "ground.S", "slider": "face.S", "axis": [1.0, 0.0]}
    scene["bodies"]["face"] = {"mass": 1.0, "inertia": 1e-3, "points": {"S": [0.0, 0.0]}}
    scene["joints"] |= {"pushes": slide}
    scene["joints"]["stop"]["follower"] = "face.S"
    scene["drivers"] = {"motor": {"joint": "pushes", "motion": motion}}
    scene["start"] = {"guides": {"stop": {"offset": gap - LASH}}}
    assert scales(scene) == pytest.approx(((4.0 * half * LASH) ** 0.5) * np.array([1.0, 1e-5, 1.0]))
    after, facts = ended(scene, 1.1 * (gap / half) ** 0.5)
    assert after == pytest.approx(-1.5 * (4.0 * half * gap) ** 0.5, rel=2e-3)
    assert facts["slow_impacts"] == 0


def test_impacts_below_a_given_floor_are_counted_and_told() -> None:
    speed, floor = 1e-4, 1e-3
    back, facts = ended(stop(speed, impact_rate_floor=floor), 4.0 * LASH / speed)
    assert -back / speed == pytest.approx(0.9127, abs=1e-3)  # damping a tenth of what is asked
    assert facts["slow_impacts"] == 1
    assert "1 impact was slower than the impact_rate_floor (0.001 m/s)" in facts["note"]


def scales(scene: dict[str, Any]) -> tuple[float, float, float]:
    """Return the speed, the floor and the rate at rest of the stop, m/s; lengths of 1 m."""
    made = scene_of(scene)
    pair = contact_pairs(made)["stop"]
    return (
        scene_speed(made, LASH, 1.0),
        impact_floor(made, pair, 1.0),
        resting_rate(made, pair, 1.0),
    )


def test_a_floor_is_a_share_of_the_speeds_of_the_scene() -> None:
    slow = stop(1e-4)
    assert scales(slow) == pytest.approx((1e-4, 1e-9, 1e-4))
    fall = (2.0 * 9.81 * LASH) ** 0.5
    assert scales(slow | {"gravity": [0.0, -9.81]}) == pytest.approx((fall, 1e-5 * fall, MOST))
    driven = slow | {"drivers": {"motor": {"joint": "guide", "speed": -0.02}}}
    assert scales(driven) == pytest.approx((0.02, 2e-7, MOST))
    spring = {"type": "spring-damper", "first": "ground.S", "second": "disc.c", "stiffness": 10.0}
    sprung = (2.0 * 10.0 / 0.1 * LASH) ** 0.5
    assert scales(slow | {"forces": {"spring": spring}})[0] == pytest.approx(sprung)
    assert scales(stop(1e5))[1:] == (MOST, MOST)


def test_where_nothing_moves_or_a_floor_is_given_that_is_it() -> None:
    assert scales(stop(0.0)) == (0.0, MOST, MOST)
    assert scales(stop(1e-4, impact_rate_floor=0.02))[1:] == (0.02, 0.02)
    assert scales(stop(0.3, law="tsuji", effective_mass=0.1))[1:] == (0.0, 0.0)
