"""Phases of friction along a branch: where an oscillator begins to stick, in closed form."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from benchmarks.known_orbits import RUBS, followed, with_dry_friction
from jointplay.records.branch import Branch, Special
from jointplay.solver.continuation.friction_phases import phases

RATIO = 1.25
ROWS = np.arange(1001) / 1000.0


def least_drive() -> float:
    """Return the force below which Den Hartog's oscillator sticks where it turns round, N.

    Its motion without stops begins at a turning point as f + V cos(r t + phase) + B cos t + C sin t
    (Den Hartog 1931, Trans. ASME 53:107); it stops as soon as it does not speed up from there.
    """
    half, response = math.pi / RATIO, 1.0 / (1.0 - RATIO * RATIO)
    cosine, sine = math.cos(half), math.sin(half)

    def faster(f: float) -> float:
        rest = sine / (RATIO * (1.0 + cosine))
        amplitude = math.sqrt(response**2 - (rest * f) ** 2)
        b = -2.0 * f * (1.0 + cosine) / sine / ((1.0 + cosine) ** 2 / sine + sine)
        return (amplitude - f - b) * RATIO * RATIO + b

    return RUBS / brentq(faster, 0.5, 0.71)


@cache
def along(ramp: float) -> Branch:
    return of(with_dry_friction(RATIO, ramp))


def of(scene: dict[str, Any]) -> Branch:
    values = {"from": 0.29, "to": 0.279, "count": 30}
    job = {"scene": scene, "parameter": "drive", "values": values, "settle": 60}
    (branch,) = followed(job | {"largest_step": 0.5})
    return branch


def special(branch: Branch, label: str) -> list[Special]:
    return [one for one in branch.special if one.label == label]


def test_sticking_begins_where_den_hartogs_motion_without_stops_ends() -> None:
    ramps, found = (4e-3, 2e-3, 1e-3), []
    for ramp in ramps:
        (one,) = special(along(ramp), "ST")
        assert one.bound < 1e-6
        assert one.note.startswith("friction sticks 0 and slides 2 times a period before, sticks 2")
        found.append(one.value)
    known = least_drive()
    apart = np.array(found) - known
    # a ramp's slow passage takes the power two thirds of its width, and so is the distance
    assert apart[0] / apart[1] == pytest.approx(2.0 ** (2.0 / 3.0), rel=0.1)
    powers = np.array(ramps)[:, None] ** (np.array([0.0, 2.0, 3.0]) / 3.0)
    assert np.linalg.solve(powers, found)[0] == pytest.approx(known, rel=2e-4)


def test_friction_that_changes_nothing_leaves_a_branch_as_it_was() -> None:
    branch = along(2e-3)
    assert [one.label for one in branch.special] == ["EP", "ST", "EP"]
    assert (np.diff(branch.column("value")) < 0.0).all()
    assert not branch.column("unstable").any()


def test_a_force_over_the_rate_of_a_distance_sticks_where_one_over_that_of_a_place_does() -> None:
    rubbing = with_dry_friction(RATIO, 1e-3)["forces"]["rubbing"] | {
        "over": {"quantity": "distance", "first": "ground.anchor", "second": "mass.centre"}
        | {"rate": True}
    }
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": 1.0}
    forces = {"spring": spring, "rubbing": rubbing, "drive": shaking(1.0, RATIO)}
    scene = sliding("dry-friction", 1e-13, **forces)
    drive = {"help": "Force.", "unit": "N", "default": 1.0}
    scene["parameters"] = {"drive": drive | {"targets": [{"path": "/forces/drive/magnitude"}]}}
    (one,), (other,) = special(of(scene), "ST"), special(along(1e-3), "ST")
    assert one.value == pytest.approx(other.value, rel=1e-5)


@pytest.mark.parametrize(
    ("slip", "known"),
    [
        (np.cos(2.0 * np.pi * ROWS), (0, 2)),
        (2.0 + np.cos(2.0 * np.pi * ROWS), (0, 1)),
        (0.001 * np.cos(2.0 * np.pi * ROWS), (1, 0)),
        (np.full(1001, 2.0), (0, 1)),
        # held for a tenth of the period on its way down, not on its way up
        (np.interp(ROWS, [0.0, 0.3, 0.4, 0.7, 1.0], [1.0, 0.0, -1e-3, -1.0, 1.0]), (1, 2)),
        # comes to rest, and goes on the same way
        (np.maximum(np.cos(2.0 * np.pi * ROWS), 0.0), (1, 1)),
    ],
)
def test_phases_are_counted_round_the_period(
    slip: np.ndarray[tuple[int], np.dtype[np.float64]], known: tuple[int, int]
) -> None:
    for shift in (0, 123, 600):
        around = np.roll(slip[:-1], shift)
        assert phases(np.append(around, around[0]), -2e-3, 2e-3) == known
