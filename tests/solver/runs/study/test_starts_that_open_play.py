"""A start that opens play depends on how large it is: points and candidates have their own."""

from typing import Any

import numpy as np
import pytest

from jointplay.solver.calibration.measure import Measurement
from jointplay.solver.computations import computation_of
from jointplay.solver.kinds import admit, admit_calibration

ASIDE = 5e-4
HANGING: dict[str, Any] = {
    "name": "hanging",
    "ground": {"points": {"O": [0.0, 0.0]}},
    "bodies": {"A": {"mass": 1.0, "inertia": 0.01, "points": {"O": [-0.1, 0.0]}}},
    "gravity": [0.0, -9.81],
    "joints": {
        "k": {
            "type": "revolute", "bearing": "ground.O", "journal": "A.O",
            "clearance": {
                "radial_clearance": 1e-3, "bearing_radius": 0.01,
                "contact": {"law": "lankarani-nikravesh", "restitution": 0.8},
            },
        },
    },
    "start": {"points": {"A.O": [ASIDE, 0.0]}, "angles": {"A": 0.0}},
    "parameters": {
        "c": {
            "help": "play", "unit": "m",
            "targets": [{"path": "/joints/k/clearance/radial_clearance"}],
        }
    },
}  # fmt: skip
CLEARANCES = [1e-3, 1e-4, 3e-4, 2e-3]
"""In the first and the last the pin can be where it is asked to be."""


def peaks(clearances: list[float]) -> dict[float, bytes]:
    """Return, by clearance, the bits of the peaks of a sweep."""
    job = {"kind": "sweep", "scene": HANGING, "points": [{"c": c} for c in clearances]}
    admission = admit(job | {"duration": 1e-3, "channels": ["k.eccentricity_x"]})
    ended = [end for piece in computation_of(admission, 0).slices() for end in piece.ended]
    return {clearances[end.point]: end.peaks.tobytes() for end in ended}


def test_a_point_starts_as_it_does_alone():
    alone = {c: peaks([c])[c] for c in CLEARANCES}
    assert len(set(alone.values())) == 2  # aside, and in the middle, where there is less room
    assert peaks(CLEARANCES) == alone
    assert peaks(CLEARANCES[::-1]) == alone


@pytest.mark.parametrize("order", [1, -1])
def test_so_does_a_candidate(order):
    target = {"channel": "k.eccentricity_x", "to": 1e-3, "value": 1e-4, "statistic": "maximum"}
    calibration = admit_calibration(
        {
            "kind": "calibration",
            "scene": HANGING,
            "parameters": {"c": {"minimum": 1e-4, "maximum": 2e-3}},
            "cases": [{"targets": [target]}],
            "search": {"population": 2, "generations": 1},
            "spread": {"generations": 2},
        }
    )
    found = Measurement(calibration, every=True)(np.array([[1e-4], [1e-3]])[::order])[::order]
    assert found[1, 0] == pytest.approx(ASIDE, abs=1e-6)  # it falls by 5e-6 m meanwhile
    assert found[0, 0] < 1e-4
