"""Tangent vectors of a mass that flies between two walls whose force is linear in the depth."""

import math

import numpy as np
import pytest

from jointplay.solver.scene.document import Scene
from tests.solver.kernels.tangent_runs import bundle_of, growth, problem

MASS, STIFFNESS, PLAY, SPEED = 2.0, 8e4, 0.01, 0.3
DURATION = 1.0


def scene() -> Scene:
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": STIFFNESS, "exponent": 1.0},
        "dissipation": {"law": "none"},
    }
    clearance = {"radial_clearance": PLAY, "bearing_radius": 0.1, "contact": contact}
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "mass.C", "axis": [1.0, 0.0]}
    stop = {"type": "revolute", "bearing": "ground.O", "journal": "mass.C", "clearance": clearance}
    return Scene.model_validate(
        {
            "name": "between-walls",
            "ground": {"points": {"O": [0.0, 0.0]}},
            "bodies": {"mass": {"mass": MASS, "inertia": 1e-3, "points": {"C": [0.0, 0.0]}}},
            "joints": {"guide": guide, "stop": stop},
            "start": {"velocities": {"mass": [SPEED, 0.0]}},
        }
    )


# an end of contact that is passed over as any other step is worth 9e-2 at 1e-6, 2e-3 at 1e-9
@pytest.mark.parametrize(("tolerance", "accuracy"), [(1e-6, 4e-2), (1e-9, 5e-4)])
def test_a_tangent_passes_onsets_and_openings_where_the_stiffness_jumps(
    tolerance: float, accuracy: float
) -> None:
    bundle = bundle_of([problem(scene(), DURATION, tolerance)])
    lane = bundle.lane(0)
    place, rate = lane["tangent"]
    bundle.advance(10**8)
    found = np.exp(growth(bundle)[:, 1].sum()) * lane["tangent"]
    # a contact is half a swing: it turns the tangent round, and a flight adds rate * time
    contact = math.pi * math.sqrt(MASS / STIFFNESS)
    contacts = round((DURATION - PLAY / SPEED) / (contact + 2.0 * PLAY / SPEED))
    flown = DURATION - contacts * contact
    turned = (-1.0) ** contacts
    assert contacts > 10
    assert bundle.lane(0).number("mode0") == 0.0  # it ends in flight
    expected = turned * np.array([place + flown * rate, rate])
    np.testing.assert_allclose(found, expected, rtol=accuracy)
