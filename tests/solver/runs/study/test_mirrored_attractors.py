"""Attractors that are mirror images of each other, and whose means are zero."""

import copy
import math

import numpy as np

from jointplay.local import run
from jointplay.records.attractors import attractors_of
from jointplay.solver.runs.study.cycles import covariances
from tests.solver.continuation.test_branches_from_rest import job

ASIDE = 0.2
"""rad from rest, where the rods start."""


def test_two_rods_swing_in_phase_or_opposed() -> None:
    """Each swings once in two periods of the pivot; rods that start as mirror images stay so."""
    scene = job(7.6, 0.06, 0.07)["scene"]
    for field, name, other in (
        ("bodies", "rod", "other"),
        ("joints", "pin", "second"),
        ("forces", "damper", "brake"),
    ):
        scene[field][other] = copy.deepcopy(scene[field][name])
    scene["bodies"]["pivot"]["points"]["anchor"] = [3.0, 0.0]
    scene["joints"]["second"] |= {"bearing": "pivot.anchor", "journal": "other.pin"}
    scene["forces"]["brake"] |= {"second": "other.pin"}
    scene["start"]["angles"] = {"rod": ASIDE - 0.5 * math.pi, "other": 0.0}
    positions = [side * ASIDE - 0.5 * math.pi for side in (1.0, -1.0)]
    basins = {
        "kind": "basins",
        "scene": scene,
        "along": {"start": "/start/angles/other", "values": positions},
        "by": {"start": "/start/angular_velocities/rod", "values": [0.0]},
        "settle": 250,
        "record": 16,
        "indicators": ["recurrence"],
        "tolerance": 1e-6,
    }
    found = attractors_of(run(basins, processes=1).study())
    assert [(one.name, one.points) for one in found.found] == [("period-2 A", 1), ("period-2 B", 1)]


def test_covariances_are_known_as_well_as_states() -> None:
    """A state that is off by a share of what counts as one moves them by twice that at most."""
    generator = np.random.default_rng(4)
    for size in (1e-3, 1.0, 1e3):
        away = generator.standard_normal((6, 5)) * generator.choice([1.0, size], 5)
        off = 1e-3 * generator.uniform(-1.0, 1.0, away.shape)
        moved = np.abs(covariances(away + off) - covariances(away))
        # to first order of the error, and half as much again for what the divisor moves
        assert moved.max() < 3e-3
