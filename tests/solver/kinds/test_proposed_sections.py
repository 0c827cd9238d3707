"""Sections that are proposed of a scene are taken in its motion, whatever drives it."""

import math

import numpy as np
import pytest

from jointplay.local import run
from jointplay.solver.kinds.assembled import resolved_scene
from jointplay.solver.kinds.proposed_sections import proposed_sections

RECORD = 3
PUSHED = {"preset": "pendulum", "parameters": {"angular_velocity": -30.0}}  # it goes round


def proposed(scene):
    return [section.model_dump() for section in proposed_sections(resolved_scene(scene))]


@pytest.mark.parametrize(
    ("scene", "channel", "value", "direction"),
    [
        ({"preset": "double-pendulum"}, "upper.omega", 0.0, "up"),
        (PUSHED, "rod.theta", 0.0, "down"),
        ({"preset": "andrews-squeezer"}, "K1.theta", -0.0617139, "up"),  # a torque turns it
    ],
    ids=["at-rest", "pushed", "turned"],
)
def test_a_crossing_is_passed_again_and_again(scene, channel, value, direction):
    (section,) = proposed(scene)
    assert section == {"channel": channel, "value": value, "direction": direction}
    job = {"kind": "poincare", "scene": scene, "section": section, "settle": 0, "record": RECORD}
    (passed,) = run(job | {"observables": [channel]}, processes=1).study().sections(channel)
    turn = 2.0 * math.pi if channel.endswith(".theta") else math.inf
    off = [math.remainder(one - value, turn) for one in passed]
    np.testing.assert_allclose(off, np.zeros(RECORD), atol=1e-9)  # located to 1e-13 of a step


def test_a_period_comes_before_contacts_and_contacts_before_crossings():
    forms = [next(iter(section)) for section in proposed({"preset": "impact-oscillator"})]
    assert forms == ["crank_angle", "onset", "channel"]
    assert proposed({"preset": "bouncing-journal"})[0] == {"onset": "bearing"}
