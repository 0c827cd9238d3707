"""Local runs that fail keep all that they computed, whatever their samples."""

import math

import numpy as np
import pytest

import jointplay
from jointplay.client import JobFailed

SPEED, OMEGA = 0.2, 20.0
"""m/s and rad/s of a mass of 1 kg on a spring."""
SCENE = {
    "name": "mass-on-spring",
    "ground": {"points": {"O": [0.0, 0.0]}},
    "bodies": {"mass": {"mass": 1.0, "inertia": 1.0, "points": {"c": [0.0, 0.0]}}},
    "joints": {
        "guide": {"type": "prismatic", "guide": "ground.O", "slider": "mass.c", "axis": [1.0, 0.0]}
    },
    "forces": {
        "spring": {
            "type": "spring-damper",
            "first": "ground.O",
            "second": "mass.c",
            "stiffness": OMEGA**2,
        }
    },
    "start": {"velocities": {"mass": [SPEED, 0.0]}},
}
FENCE = {
    "type": "force",
    "first": "ground.O",
    "second": "mass.c",
    "magnitude": 1.0,
    "direction": [1.0, 0.0],
    "over": {"quantity": "x"},
    "course": {
        "type": "table",
        "knots": [-8e-3, 8e-3],
        "values": [0.0, 0.0],
        "outside": "refused",
    },
}
"""A force that is given up to 8 mm; the mass would go to 10 mm."""


def failed(folder, scene, **fields):
    with pytest.raises(JobFailed):
        jointplay.run(scene, output=folder, certificate=False, **fields)
    return jointplay.load(folder)


def test_a_motion_that_grows_beyond_all_numbers_is_kept(tmp_path):
    """With steps of four radians Runge and Kutta's method multiplies a vibration by 7.6 in each."""
    step = 4.0 / OMEGA
    fields = {"method": "rk4", "step": step, "output_step": step, "duration": 200.0}
    job = failed(tmp_path / "OUT", SCENE, **fields)
    assert job.error.code == "fixed-step-too-long"
    window = job.window("mass.x")
    z = 4.0j
    grown = np.cumprod(np.full(40, 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24))
    np.testing.assert_allclose(window["mass.x"][1:41], SPEED / OMEGA * grown.imag, rtol=1e-10)
    assert len(window.time) > 100
    assert job.statistics["energy"] is None  # it is beyond all numbers
    assert job.statistics["steps"] >= len(window.time) - 1


def test_windows_of_a_run_that_failed_go_up_to_its_end(tmp_path):
    scene = {**SCENE, "forces": {**SCENE["forces"], "fence": FENCE}}
    job = failed(tmp_path / "OUT", scene, duration=1.0, output_step=1.0, tolerance=1e-10)
    end = math.asin(8e-3 * OMEGA / SPEED) / OMEGA
    assert job.progress.time == pytest.approx(end, rel=1e-7)
    for peak in (job.results.peaks()["mass.x"], job.results.peaks(0.001, 1.0)["mass.x"]):
        assert (peak.maximum, peak.maximum_time) == pytest.approx((8e-3, end), rel=1e-7)
    window = job.window("mass.x", 0.0, 1.0, step=0.01)
    expected = SPEED / OMEGA * np.sin(OMEGA * np.array([0.0, 0.01, 0.02, 0.03, 0.04]))
    np.testing.assert_allclose(window["mass.x"], expected, atol=1e-10)
