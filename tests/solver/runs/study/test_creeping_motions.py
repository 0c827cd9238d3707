"""Motions that creep towards one attractor are not counted on several."""

from typing import Any

import numpy as np

from jointplay.local import run
from jointplay.records.attractors import attractors_of


def heavily_damped() -> dict[str, Any]:
    """Return x'' = -2 x' - 0.01 x + 0.5 cos(t): it closes in by 3 % in a period."""
    ends = {"first": "ground.O", "second": "mass.centre"}
    course = {"type": "sinusoidal", "amplitude": 1.0, "frequency": 1.0, "phase": np.pi / 2.0}
    push = {"type": "force", **ends, "magnitude": 0.5, "direction": [1.0, 0.0], "course": course}
    held = {"type": "spring-damper", "first": "ground.anchor", "second": "mass.centre"}
    return {
        "name": "heavily-damped",
        "ground": {"points": {"O": [0.0, 0.0], "anchor": [-100.0, 0.0]}},
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
            "spring": held | {"stiffness": 0.01, "free_length": 100.0, "damping": 2.0},
            "push": push,
        },
    }


def found(settle: int) -> dict[str, int]:
    job: dict[str, Any] = {
        "kind": "basin-stability",
        "scene": heavily_damped(),
        "starts": {
            "/start/points/mass.centre/0": {"distribution": "uniform", "low": -1.0, "high": 1.0}
        },
        "samples": 24,
        "settle": settle,
        "record": 8,
        "tolerance": 1e-6,
        "indicators": ["recurrence"],
    }
    study = run(job, processes=1).study()
    return {one.name: one.points for one in attractors_of(study).found}


def test_starts_of_a_linear_system_end_on_one_attractor_or_are_undecided() -> None:
    early = found(140)
    assert set(early) == {"undecided", "period-1"}
    assert early["undecided"] > 12
    assert found(500) == {"period-1": 24}
