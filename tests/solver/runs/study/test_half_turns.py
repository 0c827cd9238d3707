"""Shafts behind gears: a motion that comes back after several periods of the drive."""

from typing import Any

import pytest

from jointplay.solver.runs.study.run import StudyRun
from tests.solver.runs.study.jobs_of_studies import study


def cam_shaft(ratio: float) -> dict[str, Any]:
    """Return a pendulum in thick oil on a wheel that goes round at a share of the drive's speed."""
    pin = {"type": "revolute"}
    return {
        "name": "cam-shaft",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "Q": [0.5, 0.0]}},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 0.01, "points": {"O": [0.0, 0.0]}},
            "wheel": {
                "mass": 1.0,
                "inertia": 0.02,
                "points": {"Q": [0.0, 0.0], "pin": [0.05, 0.0]},
            },
            "rod": {
                "mass": 1.0,
                "inertia": 0.02,
                "points": {"pin": [0.0, 0.2], "tip": [0.0, -0.2]},
            },
        },
        "joints": {
            "O": {**pin, "bearing": "ground.O", "journal": "crank.O"},
            "Q": {**pin, "bearing": "ground.Q", "journal": "wheel.Q"},
            "R": {**pin, "bearing": "wheel.pin", "journal": "rod.pin"},
        },
        "gears": {"belt": {"first": "O", "second": "Q", "ratio": ratio}},
        "drivers": {"motor": {"joint": "O", "speed": 4.0}},
        "forces": {
            "oil": {
                "type": "spring-damper",
                "first": "rod.tip",
                "second": "ground.Q",
                "damping": 20.0,
            }
        },
    }


@pytest.mark.parametrize(("ratio", "period"), [(0.5, 2), (-0.5, 2), (1.5, 2), (1.0 / 3.0, 3)])
def test_the_period_is_that_of_the_ratio(ratio: float, period: int) -> None:
    job = {"kind": "poincare", "scene": cam_shaft(ratio), "settle": 60, "record": 40}
    run = StudyRun(study(job, indicators=["recurrence"]), 0)
    (end,) = (end for piece in run.slices() for end in piece.ended)
    assert end.indicators["period"] == period
