"""Loops that a driver sets in motion from rest, beside play: only rounding moves them yet."""

import copy
import math
from typing import Any

import numpy as np
import pytest

from jointplay.solver.kernels.emit.closing import drift
from tests.solver.completed_runs import run

CRANK, COUPLER, ROCKER, FRAME = 0.2, 1.1, 0.7, 1.0
"""Lengths of the four-bar, m."""


def bar(length: float) -> dict[str, Any]:
    points = {"a": [-length / 2, 0.0], "b": [length / 2, 0.0]}
    return {"mass": 1.0, "inertia": length**2 / 12, "points": points}


def pin(bearing: str, journal: str) -> dict[str, Any]:
    return {"type": "revolute", "bearing": bearing, "journal": journal}


CONTACT = {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": 0.5}
PLAY = {"radial_clearance": 1e-4, "bearing_radius": 0.01, "contact": CONTACT}
FOUR_BAR = {
    "name": "four-bar",
    "gravity": [0.0, -9.81],
    "ground": {"points": {"O": [0.0, 0.0], "C": [FRAME, 0.0]}},
    "bodies": {
        "crank": bar(CRANK),
        "coupler": bar(COUPLER),
        "rocker": bar(ROCKER),
        "bob": bar(0.2),
    },
    "joints": {
        "O": pin("ground.O", "crank.a"),
        "A": pin("crank.b", "coupler.a"),
        "B": pin("coupler.b", "rocker.b"),
        "C": pin("ground.C", "rocker.a"),
        "P": pin("coupler.b", "bob.a") | {"clearance": PLAY},
    },
    "start": {"angles": {"crank": 0.5, "coupler": 0.6, "rocker": 1.5}},
}
QUINTIC = [0.0, 0.0, 0.0, 10.0, -15.0, 6.0]
MOTIONS = {
    "rise": {
        "type": "piecewise-polynomial",
        "knots": [0.0, 0.5, 1.0],
        "coefficients": [[c / 0.5**k for k, c in enumerate(QUINTIC)], [1.0]],
        "outside": "held",
    },
    "table": {
        "type": "table",
        "knots": [0.0, 0.5, 1.0],
        "values": [0.0, 1.0, 0.0],
        "outside": "held",
    },
    "ramp": {"type": "ramp", "end": 1.0, "length": 0.02},
}


@pytest.mark.parametrize("motion", MOTIONS)
def test_a_four_bar_with_a_bob_in_play_is_moved_from_rest(motion: str) -> None:
    scene = copy.deepcopy(FOUR_BAR)
    scene["drivers"] = {"m": {"joint": "O", "position": 0.5, "motion": MOTIONS[motion]}}
    found = run(scene, 0.03, tolerance=1e-6)
    crank, rocker = found["crank.theta"], found["rocker.theta"]
    assert crank[-1] > 0.5 + 1e-3
    # the circles about the crank's end and the rocker's pin meet where the coupler ends
    x, y = CRANK * np.cos(crank) - FRAME, CRANK * np.sin(crank)
    apart = np.hypot(x, y)
    inside = np.arccos((ROCKER**2 + apart**2 - COUPLER**2) / (2 * ROCKER * apart))
    expected = np.arctan2(y, x) - inside
    off = np.angle(np.exp(1j * (rocker - expected)))
    assert np.abs(off).max() < 1e-11  # what closes loops leaves the square of an error of 1e-6
    assert math.isfinite(found["bob.theta"][-1])


@pytest.mark.parametrize(
    ("correction", "expected"), [(1e-17, 0.0), (1e-9, 1e-6), (math.nan, math.nan)]
)
def test_a_correction_counts_unless_it_is_rounding(correction: float, expected: float) -> None:
    still = dict.fromkeys(["stage0", "stage1", "correction1"], 0.0)
    units = dict.fromkeys(["tried", "full", "fastest"], 1.0)
    weights = {"weight0": 1e6, "weight1": 1e6}
    numbers: dict[str, Any] = still | units | weights | {"correction0": correction}
    assert drift(numbers.__getitem__, 1) == pytest.approx(expected, nan_ok=True)
