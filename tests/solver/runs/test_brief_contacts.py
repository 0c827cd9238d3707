"""A contact that is shorter than a step is felt: the impulse of a mass that only just touches."""

import math

import pytest

from tests.solver.completed_runs import run
from tests.solver.laws.test_abrupt_onsets import thrown


@pytest.mark.parametrize("accuracy", ["draft", "standard", "reference"])
@pytest.mark.parametrize("depth", [1e-9, 1e-10])
def test_a_mass_that_hardly_comes_to_its_stop_is_pushed_by_it(accuracy: str, depth: float) -> None:
    """The stop is too soft to bend the parabola: the impulse is an integral over that."""
    mass, clearance, stiffness, gravity = 1e-3, 1e-4, 1e8, 9.81
    scene = thrown(mass, clearance, stiffness, 1.0, {"law": "exact", "restitution": 0.8})
    upwards = math.sqrt(2.0 * gravity * (clearance + depth))
    scene |= {"gravity": [0.0, -gravity], "start": {"velocities": {"j": [0.0, upwards]}}}
    found = run(scene, 1.9 * upwards / gravity, accuracy=accuracy)
    (contact,) = found.contacts("B")
    impulse = 3.0 / 8.0 * math.pi * stiffness * depth**2 * math.sqrt(2.0 / gravity)
    # 4e-4 by the force in the weight; a standard run knows so small a one to a hundredth
    assert contact["impulse"] == pytest.approx(impulse, rel=0.02)
    lasts = 2.0 * math.sqrt(2.0 * depth / gravity)
    assert contact["release"] - contact["onset"] == pytest.approx(lasts, rel=1e-3)
