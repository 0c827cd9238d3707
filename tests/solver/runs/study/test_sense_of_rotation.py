"""Rotation numbers of shaken oscillators: their own frequency in that of the shaking."""

import pytest

from tests.solver.runs.study.test_run import Computed


@pytest.mark.parametrize("ratio", [0.618, 0.93, 1.07, 1.618])
def test_a_free_oscillation_turns_by_its_frequency_whatever_spreads_most(ratio: float) -> None:
    # below resonance positions spread more than speeds in their scales, above it is the other way
    # round, and the plane in which sections are seen has its axes exchanged
    rest = {"first": "ground.O", "second": "mass.centre"}
    shaking = {"type": "force", **rest, "magnitude": 0.02, "direction": [1.0, 0.0]}
    shaking |= {"course": {"type": "sinusoidal", "amplitude": 1.0, "frequency": 1.0}}
    scene = {
        "name": "shaken",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"mass": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}}},
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "mass.centre",
                "axis": [1.0, 0.0],
            }
        },
        "forces": {
            "spring": {"type": "spring-damper", **rest, "stiffness": ratio**2},
            "shaking": shaking,
        },
        "start": {"points": {"mass.centre": [0.1, 0.0]}},
    }
    job = {"kind": "poincare", "scene": scene, "settle": 2, "record": 200}
    found = Computed({**job, "indicators": ["rotation"]}).ends[0].indicators
    assert found["rotation"] == pytest.approx(ratio % 1.0, abs=1e-9)
