"""Multipliers are pure numbers: those of a mechanism of micrometres are those of one of metres."""

from typing import Any

import numpy as np
import pytest

from jointplay.solver.computations import computation_of
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.kinds import admit

APART, PRESSED = 0.0, 0.8
"""Where the drive is at the sections of the orbit, rad: the bar is off the stop, or at it."""


def rocker(size: float, phase: float) -> dict[str, Any]:
    """Return a bar that is shaken by a spring and strikes a stop, lengths in units of `size` m.

    Forces are in proportion to lengths, so that all times and angles stay.
    """

    def at(x: float, y: float) -> list[float]:
        return [size * x, size * y]

    contact = {
        "law": "lankarani-nikravesh",
        "stiffness": 1e5 * size**-0.5,
        "restitution": 0.8,
        "impact_rate_floor": 1e-7 * size,
    }
    stop = {"radial_clearance": 0.2 * size, "bearing_radius": 0.3 * size, "contact": contact}
    moved = {"type": "spring-damper", "second": "bar.tip"}
    speed = {"help": "Of the crank.", "unit": "rad/s", "default": 25.0}
    return {
        "name": "rocker",
        "gravity": [0.0, 0.0],
        "ground": {
            "points": {
                "O": at(-0.01, 1.0),
                "pivot": at(0.0, 0.0),
                "stop": at(-0.2, 1.0),
                "anchor": at(-1.0, 1.0),
            }
        },
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": 1e-3 * size**2,
                "points": {"O": at(0.0, 0.0), "pin": at(0.005, 0.0)},
            },
            "bar": {
                "mass": 1.0,
                "inertia": 1e-3 * size**2,
                "points": {"pivot": at(0.0, -1.0), "tip": at(0.0, 0.0)},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "pivot": {"type": "revolute", "bearing": "ground.pivot", "journal": "bar.pivot"},
            "stop": {
                "type": "revolute",
                "bearing": "ground.stop",
                "journal": "bar.tip",
                "clearance": stop,
            },
        },
        "drivers": {"motor": {"joint": "O", "speed": 25.0, "position": phase}},
        "forces": {
            "spring": {**moved, "first": "crank.pin", "stiffness": 400.0},
            "damper": {**moved, "first": "ground.anchor", "damping": 2.0},
        },
        "start": {"angles": {"bar": 0.005}},
        "parameters": {"speed": speed | {"targets": [{"path": "/drivers/motor/speed"}]}},
    }


def first_orbit(size: float, phase: float) -> tuple[complex, float, float]:
    """Return the first multiplier of the orbit, its error, and the latched rate of its section."""
    job = {
        "kind": "continuation",
        "scene": rocker(size, phase),
        "parameter": "speed",
        "values": {"from": 25.0, "to": 25.05, "count": 1},
        "settle": 100,
    }
    study = admit(job)
    assert isinstance(study, ContinuationStudy)
    rows = [rows.values for one in computation_of(study, 0).slices() for rows in one.rows]
    names = [channel.name for channel in study.observables]
    found = dict(zip(names, np.concatenate(rows)[0].tolist(), strict=True))
    multiplier = complex(found["multiplier_1.real"], found["multiplier_1.imaginary"])
    return multiplier, found["multiplier_error"], found["impact_rate.stop"]


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-5])
def test_multipliers_depend_neither_on_units_nor_on_where_the_section_is(size: float) -> None:
    expected, _, apart = first_orbit(1.0, APART)
    found, error, rate = first_orbit(size, PRESSED)
    assert apart == 0.0
    assert rate == pytest.approx(0.4454635 * size, rel=1e-6)
    assert abs(found - expected) < 2e-6
    assert error < 1e-5
