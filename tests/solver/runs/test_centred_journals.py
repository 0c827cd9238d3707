"""Bristles of journals at the centre of bearings that are far from the world's origin."""

from typing import Any

import pytest

import jointplay
from jointplay.client import JobFailed

FAR = [3.0, -1.3]


def scene(at: list[float], eccentricity: float = 0.0) -> dict[str, Any]:
    clearance = {
        "radial_clearance": 1e-3,
        "bearing_radius": 0.01,
        "contact": {"law": "lankarani-nikravesh", "stiffness": 1e9, "restitution": 0.9},
        "friction": {
            "law": "lugre",
            "static_coefficient": 0.2,
            "kinetic_coefficient": 0.1,
            "bristle_stiffness": 1e7,
        },
    }
    bearing = {
        "type": "revolute",
        "bearing": "ground.O",
        "journal": "disc.centre",
        "clearance": clearance,
    }
    return {
        "name": "disc",
        "bodies": {"disc": {"mass": 1.0, "inertia": 5e-5, "points": {"centre": [0.0, 0.0]}}},
        "ground": {"points": {"O": at}},
        "joints": {"bearing": bearing},
        "gravity": [1.3, -9.7],
        "start": {"joints": {"bearing": {"eccentricity": [eccentricity, 0.0]}}},
    }


def fall(at: list[float], eccentricity: float = 0.0) -> None:
    job = {"method": "tsitouras", "tolerance": 1e-9, "duration": 1e-3, "certificate": False}
    jointplay.run(scene(at, eccentricity), **job)


def test_a_run_that_rounding_stops_says_so_and_what_helps_does() -> None:
    with pytest.raises(JobFailed, match="rounding of positions") as failed:
        fall(FAR)
    assert "the journal of 'bearing'" in str(failed.value)
    assert "3.27 m from the world's origin" in str(failed.value)
    assert "an eccentricity of 1e-09 m or more" in str(failed.value)
    fall(FAR, 1e-9)
    fall([0.0, 0.0])
