"""Certificates of fixed steps hold of the motion, however long the steps are."""

from typing import Any

import numpy as np
import pytest

import jointplay

AMPLITUDE, FREQUENCY = 0.01, 100.0
"""m, rad/s. The method rk4 is unstable from the step 2 sqrt(2) / FREQUENCY, 28 ms, on."""


def oscillator() -> dict[str, Any]:
    return {
        "name": "oscillator",
        "bodies": {"block": {"mass": 1.0, "inertia": 1e-3, "points": {"P": [0.0, 0.0]}}},
        "ground": {"points": {"O": [0.0, 0.0], "wall": [-1.0, 0.0]}},
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "block.P",
                "axis": [1.0, 0.0],
            }
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "block.P",
                "stiffness": FREQUENCY**2,
                "free_length": 1.0,
            }
        },
        "start": {"points": {"block.P": [AMPLITUDE, 0.0]}},
    }


@pytest.mark.parametrize("step", [1e-3, 5e-3, 0.01, 0.028, 0.029, 0.03, 0.04, 0.07])
def test_no_more_is_certified_than_is_true(step: float) -> None:
    job = jointplay.run(oscillator(), method="rk4", step=step, duration=2.0, output_step=1e-3)
    time, x = job.history["time"].values, job.history["block.x"].values
    wrong = np.abs(x - AMPLITUDE * np.cos(FREQUENCY * time))
    spans = job.certificate["converged"]
    for begins, ends in spans:
        certified = (begins <= time) & (time <= ends)
        assert wrong[certified].max() <= 0.05 * 2.0 * AMPLITUDE
    assert job.certificate["channels"]["block.x"]["until"] <= job.certificate["horizon"]
    assert (spans == [[0.0, 2.0]]) == (step < 5e-3)


def test_a_ledger_that_lacks_much_is_told() -> None:
    blown = jointplay.run(oscillator(), method="rk4", step=0.035, duration=2.0).certificate
    assert blown["energy_error"] > 0.3
    assert "The energy ledger lacks 0.38 of the gross work" in blown["note"]
    fine = jointplay.run(oscillator(), method="rk4", step=1e-3, duration=2.0).certificate
    assert fine["note"] == ""
