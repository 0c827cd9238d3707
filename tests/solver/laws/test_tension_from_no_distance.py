"""A tension over the distance that is 0 at no distance: a spring, whose points may meet."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from tests.solver.completed_runs import run

STIFFNESS, SPEED, DURATION = 100.0, 1.0, 0.5


def sprung(coefficients: list[float]) -> dict[str, Any]:
    """Return a block of 1 kg on a slide that leaves the point that a tension pulls it to."""
    origin = {"points": {"O": [0.0, 0.0]}}
    tension = {"type": "tension", "first": "ground.O", "second": "block.O", "magnitude": 1.0}
    tension |= {"over": {"quantity": "distance"}}
    tension |= {"course": {"type": "polynomial", "coefficients": coefficients}}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "block.O", "axis": [1.0, 0.0]}
    return {
        "name": "sprung",
        "ground": origin,
        "bodies": {"block": {"mass": 1.0, "inertia": 1.0} | origin},
        "joints": {"slide": slide},
        "forces": {"pull": tension},
        "start": {"velocities": {"block": [SPEED, 0.0]}},
    }


def test_a_tension_that_begins_at_zero_is_a_spring_without_free_length() -> None:
    found = run(sprung([0.0, STIFFNESS]), DURATION, output_step=0.05, tolerance=1e-10)
    rate = np.sqrt(STIFFNESS)
    wanted = SPEED / rate * np.sin(rate * np.asarray(found.time))
    # a hundred tolerances of a metre: errors of some steps add up
    np.testing.assert_allclose(found.samples["block.x"], wanted, atol=1e-8)


def test_one_that_pulls_where_its_points_meet_is_refused() -> None:
    with pytest.raises(InvalidInput, match="whose course begins at 0"):
        run(sprung([1.0, STIFFNESS]), DURATION)
