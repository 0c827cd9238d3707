"""Phases of friction of a pair that opens once a period: a mass that is swung off its floor."""

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from benchmarks.known_orbits import followed
from jointplay.records.branch import Branch
from jointplay.solver.continuation.friction_phases import phases
from tests.solver.completed_runs import run

PERIOD = 0.2 * np.pi
CREEP = 2e-3
"""Slip at which friction is full, m/s."""
ROWS = np.arange(1001) / 1000.0


def swung(friction: float) -> dict[str, Any]:
    """Return a mass that a spring swings along its floor and off it, once in a period."""

    def along(first: str, **law: float) -> dict[str, Any]:
        return {"type": "spring-damper", "first": first, "second": "mass.centre", **law}

    upright = {"stiffness": 1e4, "damping": 200.0}
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": 1e5, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": 0.3},
    }
    rubbing = {"coefficient": friction, "static_velocity": CREEP / 2.0, "dynamic_velocity": CREEP}
    play = {"radial_clearance": 0.2, "bearing_radius": 0.3, "contact": contact}
    play["friction"] = {"law": "modified-coulomb", **rubbing}
    ground = {"O": [0.0, 0.0], "room": [0.0, 0.2], "west": [-100.0, 0.0], "south": [0.0, -100.0]}
    crank = {"O": [0.0, 0.0], "pin": [0.03, 0.0]}
    floor = {"bearing": "ground.room", "journal": "mass.centre", "clearance": play}
    targets = [{"path": "/joints/floor/clearance/friction/coefficient"}]
    return {
        "name": "swung-off-its-floor",
        "gravity": [0.0, -9.81],
        "ground": {"points": ground},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 1e-3, "points": crank},
            "mass": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "floor": {"type": "revolute", **floor},
        },
        "drivers": {"motor": {"joint": "O", "position": 0.0, "speed": 2.0 * np.pi / PERIOD}},
        "forces": {
            "spring": along("crank.pin", stiffness=400.0, free_length=0.0),
            "west": along("ground.west", damping=8.0),
            "south": along("ground.south", damping=8.0),
            "upright": along("ground.O", **upright) | {"type": "torsion-spring"},
        },
        "start": {"joints": {"floor": {"eccentricity": [0.0, -0.19]}}},
        "parameters": {
            "friction": {"help": "Friction.", "unit": "1", "default": friction, "targets": targets}
        },
    }


@cache
def branch() -> Branch:
    values = {"from": 0.34, "to": 0.42, "count": 20}
    job = {"scene": swung(0.3), "parameter": "friction", "values": values, "settle": 40}
    (found,) = followed(job | {"largest_step": 0.5, "tolerance": 1e-10})
    return found


def rests_and_slides(friction: float) -> tuple[int, int]:
    """Return how often a settled motion rests on the floor and slides there, by its samples."""
    found = run(swung(friction), 12.0 * PERIOD, output_step=PERIOD / 4000.0)
    slip = found["floor.slip_velocity"][-4001:-1]
    state = np.where(np.abs(slip) < CREEP, 0, np.sign(slip))
    state[found["floor.normal_force"][-4001:-1] <= 0.0] = 9
    begins = np.flatnonzero(state != np.roll(state, 1))
    lasts = np.diff([*begins, begins[0] + len(state)])
    return int(np.sum((state[begins] == 0) & (lasts > 40))), int(np.sum(np.abs(state[begins]) == 1))


def test_a_pair_that_opens_begins_to_stick_and_to_slide_where_motions_do() -> None:
    found = branch()
    assert set(found.column("impacts").tolist()) == {1.0}
    labels = [one.label for one in found.special]
    assert labels == ["EP", "ST", "ST", "EP"]
    known = [(0, 3), (1, 4), (1, 3)]  # rests and slides
    for one, (before, behind) in zip(found.special[1:3], pairwise(known), strict=True):
        assert one.bound < 1e-5
        for at, (rests, slides) in ((one.value - 5e-3, before), (one.value + 5e-3, behind)):
            assert f"sticks {rests} and slides {slides} times" in one.note
            assert rests_and_slides(at) == (rests, slides)


@pytest.mark.parametrize(("contacts", "slides"), [(1, 3), (2, 4)])
def test_phases_are_counted_within_contacts(contacts: int, slides: int) -> None:
    """A contact between two rows slides once; where a pair is apart its slip does not count."""
    slip = np.cos(2.0 * np.pi * ROWS)
    slip[(ROWS > 0.5) & (ROWS < 0.6)] = 0.0  # it sticks, and at the end of the period it is apart
    touching = (ROWS > 0.1) & (ROWS < 0.9)
    for shift in (0, 123, 600):
        around, touches = (np.roll(one[:-1], shift) for one in (slip, touching))
        told = np.append(around, around[0]), -2e-3, 2e-3, np.append(touches, touches[0]), contacts
        assert phases(*told) == (1, slides + 1)
