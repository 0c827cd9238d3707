"""Periods of mechanisms whose wheels turn at a fraction of the drive's speed."""

from typing import Any

import pytest

from tests.solver.runs.study.test_run import Computed


def geared(ratio: float) -> dict[str, Any]:
    """Return a pendulum on a wheel, damped, that another wheel drives at constant speed."""
    return {
        "name": "geared",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"A": [0.0, 0.0], "B": [0.5, 0.0]}},
        "bodies": {
            "first": {"mass": 1.0, "inertia": 1e-2, "points": {"o": [0.0, 0.0]}},
            "second": {
                "mass": 1.0,
                "inertia": 1e-2,
                "points": {"o": [0.0, 0.0], "pin": [0.05, 0.0]},
            },
            "rod": {"mass": 0.5, "inertia": 0.01, "points": {"pin": [-0.2, 0.0]}},
        },
        "joints": {
            "A": {"type": "revolute", "bearing": "ground.A", "journal": "first.o"},
            "B": {"type": "revolute", "bearing": "ground.B", "journal": "second.o"},
            "pin": {"type": "revolute", "bearing": "second.pin", "journal": "rod.pin"},
        },
        "gears": {"gear": {"first": "A", "second": "B", "ratio": ratio}},
        "drivers": {"motor": {"joint": "A", "speed": 7.0}},
        "forces": {
            "damper": {
                "type": "torsion-spring",
                "first": "ground.B",
                "second": "rod.pin",
                "damping": 0.3,
            }
        },
        "start": {"angles": {"rod": -1.5}},
    }


@pytest.mark.parametrize("settle", [100, "auto"])
@pytest.mark.parametrize(
    ("ratio", "period"), [(0.5, 2), (-0.5, 2), (1.5, 2), (-0.25, 4), (1.0 / 3.0, 3), (1.0, 1)]
)
def test_a_wheel_that_is_half_a_turn_on_is_on_one_side_of_it(
    ratio: float, period: int, settle: int | str
) -> None:
    job = {"kind": "poincare", "scene": geared(ratio), "settle": settle, "record": 32}
    found = Computed({**job, "indicators": ["recurrence"], "tolerance": 1e-6}).ends[0].indicators
    assert found["period"] == period
