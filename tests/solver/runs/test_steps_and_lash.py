"""A follower that is far away does not shorten steps, however small its lash is, and strikes alike.

A ball is a cam whose profile is the lash above its radius, a plane its flat follower.
"""

import math
from typing import Any

import numpy as np
import pytest

from tests.solver.completed_runs import run

GRAVITY, RESTITUTION = 9.81, 0.5
FREQUENCY = 20.0 * math.pi


def ball(lash: float, radius: float, *, shaken: bool) -> dict[str, Any]:
    """Return a ball on the ground, or on a table that shakes with 1.3 g at 10 Hz."""
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": 1e9, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": RESTITUTION},
    }
    plane = {
        "type": "flat-follower",
        "cam": "ball.c",
        "follower": "table.top" if shaken else "ground.O",
        "normal": [0, -1],
        "profile": {"type": "constant", "value": radius + lash},
        "clearance": {"lash": lash, "contact": contact},
    }
    scene: dict[str, Any] = {
        "name": "ball",
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {"ball": {"mass": 0.1, "inertia": 1.6e-5, "points": {"c": [0, 0]}}},
        "joints": {"plane": plane},
        "gravity": [0, -GRAVITY],
    }
    if not shaken:
        return scene | {"start": {"velocities": {"ball": [0, 2.0]}}}
    scene["bodies"]["table"] = {
        "mass": 1.0,
        "inertia": 1e-2,
        "points": {"s": [0, 0], "top": [0, 0]},
    }
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "table.s", "axis": [0, 1]}
    amplitude = 1.3 * GRAVITY / FREQUENCY**2
    motion = {"type": "sinusoidal", "amplitude": amplitude, "frequency": FREQUENCY}
    return scene | {
        "joints": {"guide": guide, "plane": plane},
        "drivers": {"shake": {"joint": "guide", "motion": motion}},
    }


@pytest.mark.parametrize("radius", [0.0, 1e-4, 0.02])
@pytest.mark.parametrize("lash", [1e-6, 1e-5, 1e-4, 1e-3])
def test_a_ball_on_a_shaken_table_takes_steps_by_its_flight(lash: float, radius: float) -> None:
    found = run(ball(lash, radius, shaken=True), 1.0, tolerance=1e-6)
    # a point, and a lash of 1e-6, took 406 262 steps: each a share of the lash at the table's speed
    assert found.statistics["steps"] < 6_000
    # where the ball starts depends on the lash; by then it has forgotten that
    approach = np.array([impact["approach_rate"] for impact in found.contacts("plane")])
    assert len(approach) in (38, 41, 42)
    np.testing.assert_allclose(approach[-3:], [0.079022, 0.035554, 0.011562], rtol=1e-3)


@pytest.mark.parametrize("lash", [1e-6, 1e-5, 1e-4, 1e-3])
def test_a_ball_thrown_up_comes_back_at_the_same_instants(lash: float) -> None:
    found = run(ball(lash, 0.0, shaken=False), 0.75, tolerance=1e-6)
    assert found.statistics["steps"] < 1_500
    contacts = found.contacts("plane")
    onsets = np.array([impact["onset"] for impact in contacts])
    approach = np.array([impact["approach_rate"] for impact in contacts])
    flights = 4.0 / GRAVITY * RESTITUTION ** np.arange(3)
    # contact itself takes up to a millisecond, and the lash is fallen through
    np.testing.assert_allclose(onsets, np.cumsum(flights), atol=3e-3)
    np.testing.assert_allclose(approach, 2.0 * RESTITUTION ** np.arange(3), atol=6e-3)
