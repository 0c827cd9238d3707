"""Extremes of runs, and of points of studies, that end before their time: of all up to there."""

import math
from typing import Any

import pytest

from jointplay.records.failure import SimulationFailed
from jointplay.records.peak import Peak
from jointplay.solver.kinds import admit
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.study.run import StudyRun

MASS, STIFFNESS, SPEED, FENCE = 2.0, 400.0, 1.1, 0.05
"""kg, N/m, m/s, m: the mass would go to 0.078 m."""
OMEGA = math.sqrt(STIFFNESS / MASS)
END = math.asin(FENCE * OMEGA / SPEED) / OMEGA
SCENE: dict[str, Any] = {
    "name": "fenced",
    "ground": {"points": {"O": [0.0, 0.0], "anchor": [-1.0, 0.0]}},
    "bodies": {"mass": {"mass": MASS, "inertia": 1e-3, "points": {"c": [0.0, 0.0]}}},
    "joints": {
        "guide": {
            "type": "prismatic",
            "guide": "ground.O",
            "slider": "mass.c",
            "axis": [1.0, 0.0],
        }
    },
    "forces": {
        "spring": {
            "type": "spring-damper",
            "first": "ground.anchor",
            "second": "mass.c",
            "stiffness": STIFFNESS,
            "free_length": 1.0,
        },
        "fence": {
            "type": "force",
            "first": "ground.O",
            "second": "mass.c",
            "magnitude": 1.0,
            "direction": [1.0, 0.0],
            "over": {"quantity": "x"},
            "course": {
                "type": "table",
                "knots": [-FENCE, FENCE],
                "values": [0.0, 0.0],
                "outside": "refused",
            },
        },
    },
    "start": {"velocities": {"mass": [SPEED, 0.0]}},
    "parameters": {
        "speed": {
            "help": "At the start.",
            "unit": "m/s",
            "targets": [{"path": "/start/velocities/mass/0"}],
        }
    },
    "outputs": [{"name": "x", "channel": "mass.x"}, {"name": "v", "channel": "mass.vx"}],
}


@pytest.mark.parametrize("settle", [0.0, 0.01])
def test_a_run_that_fails_has_the_extremes_of_what_it_computed(settle: float) -> None:
    """No sample is near its end, and no channel turns before."""
    fields = {"duration": 1.0, "output_step": 1.0, "settle": settle, "tolerance": 1e-10}
    simulation = Simulation(admit({"kind": "simulate", "scene": SCENE, **fields}))
    with pytest.raises(SimulationFailed, match="fence"):
        list(simulation.slices())
    peaks = simulation.summary().peaks
    _require(peaks["x"], peaks["v"], settle)


@pytest.mark.parametrize("settle", [0.0, 0.01])
def test_a_point_that_fails_has_the_extremes_of_what_it_computed(settle: float) -> None:
    fields = {"duration": 1.0, "settle": settle, "tolerance": 1e-10, "channels": ["x", "v"]}
    axes = {"speed": [0.1, SPEED]}
    study = admit({"kind": "sweep", "scene": SCENE, "grid": axes, **fields})
    slices = list(StudyRun(study, 0).slices())
    whole, stopped = sorted((end for one in slices for end in one.ended), key=lambda e: e.point)
    assert (whole.code, stopped.code) == ("", "outside-of-a-function")
    assert whole.peaks[0, 2] == pytest.approx(0.1 / OMEGA, rel=1e-8)
    _require(*(Peak(*row) for row in stopped.peaks.tolist()), settle)


def _require(place: Peak, speed: Peak, settle: float) -> None:
    """Require the extremes of the closed form from settling up to the fence."""
    assert place.minimum == pytest.approx(SPEED / OMEGA * math.sin(OMEGA * settle), abs=1e-9)
    assert (place.maximum, place.maximum_time) == pytest.approx((FENCE, END), rel=1e-7)
    slowest = math.sqrt(SPEED**2 - (OMEGA * FENCE) ** 2)
    assert (speed.minimum, speed.minimum_time) == pytest.approx((slowest, END), rel=1e-7)
    assert speed.maximum == pytest.approx(SPEED * math.cos(OMEGA * settle), rel=1e-9)
