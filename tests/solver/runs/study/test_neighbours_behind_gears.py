"""Values that start where their neighbour ends, with wheels that are back after some turns."""

import math

import numpy as np
import pytest

from jointplay.local import run
from tests.solver.continuation.test_wheels_behind_gears import (
    STIFFNESS,
    pushed_by_a_wheel,
    section_known,
)

RECORD = 61
"""Odd, and no multiple of three; the mass's own motion decays to 5e-7 in that time."""


def sections_of_neighbours(ratio, **fields):
    """Return (values, RECORD) positions of the mass; values but the first follow a neighbour."""
    job = {
        "kind": "bifurcation",
        "scene": pushed_by_a_wheel(ratio),
        "parameter": "stiffness",
        "values": [STIFFNESS, STIFFNESS + 1e-9, STIFFNESS + 2e-9],
        "continuation": "forward",
        "chains": 1,
        "settle": 0,
        "record": RECORD,
        "observables": ["mass.x"],
        "indicators": ["recurrence"],
    }
    study = run(job | fields, processes=1).study()
    return study.sections("mass.x"), study.indicators["period"]


@pytest.mark.parametrize("angle", [0.0, 1.0])
@pytest.mark.parametrize(("ratio", "period"), [(0.5, 2), (2.0 / 3.0, 3), (-1.5, 2), (2.0, 1)])
def test_motion_goes_on_whichever_turn_the_neighbour_ends_with(ratio, period, angle):
    """Sections are those of the closed form from the first one on: nothing is thrown."""
    positions, periods = sections_of_neighbours(ratio, section={"crank_angle": angle})
    known = [section_known(ratio, angle + 2.0 * math.pi * (1 + i))[0] for i in range(RECORD)]
    for k in (1, 2):
        np.testing.assert_allclose(positions[k], known, atol=1e-6, rtol=0.0)
        assert periods[k] == period
