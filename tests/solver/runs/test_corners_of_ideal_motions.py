"""Extremes of motions that drivers alone prescribe, where channels have corners or all but that."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from jointplay.records.peak import Peak
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.exact_motion import ExactMotion
from jointplay.solver.runs.simulate import Simulation

SOUGHT = 1e-6
"""Share of a channel's range to which its extremes are sought."""
RADIUS, DURATION = 0.1, 0.5
KNOTS, VALUES = [0.0, 0.0917, 0.2713, 0.3331, 0.5], [0.0, 0.31, 0.22, 0.71, 0.0]


def turned(motion: dict[str, Any], beside: float = 0.0) -> dict[str, Any]:
    """Return a disc whose point P passes a point of the ground, `beside` it in m, at 1.3 rad."""
    way = RADIUS + beside
    return {
        "name": "disc",
        "ground": {"points": {"O": [0.0, 0.0], "W": [way * math.cos(1.3), way * math.sin(1.3)]}},
        "bodies": {
            "disc": {"mass": 1.0, "inertia": 0.01, "points": {"O": [0, 0], "P": [RADIUS, 0]}}
        },
        "joints": {"O": {"type": "revolute", "bearing": "ground.O", "journal": "disc.O"}},
        "drivers": {"motor": {"joint": "O", **motion}},
        "forces": {
            "s": {
                "type": "spring-damper",
                "first": "ground.W",
                "second": "disc.P",
                "stiffness": 0.0,
            }
        },
    }


def extremes(scene: dict[str, Any], channel: str) -> tuple[Peak, np.ndarray]:
    """Return those of a run, and of a window that is all of it."""
    admission = admit({"kind": "simulate", "scene": scene, "duration": DURATION})
    assert isinstance(admission, Admission)
    run = Simulation(admission)
    for _ in run.slices():
        pass
    window = ExactMotion(admission).extremes([channel], np.array([0.0, DURATION]))
    return run.summary().peaks[channel], window[0, 0]


@pytest.mark.parametrize("beside", [0.0, 1e-7, 1e-5, 1e-3])
def test_the_least_distance_of_two_points_that_pass_is_found(beside: float) -> None:
    """It was wrong by up to 1e-4 m, 5e-4 of its range, by the parabola through a corner."""
    peak, window = extremes(turned({"speed": 17.0}, beside), "s.length")
    for found in (peak.minimum, window[0]):
        assert found == pytest.approx(beside, abs=SOUGHT * 2.0 * RADIUS)
    for time in (peak.minimum_time, window[1]):
        assert math.remainder(17.0 * time - 1.3, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-5)
    assert peak.maximum == pytest.approx(2.0 * RADIUS + beside, rel=1e-9)


def test_the_largest_acceleration_is_that_at_a_knot_of_the_motion() -> None:
    table = {"type": "table", "knots": KNOTS, "values": VALUES, "outside": "periodic"}
    peak, window = extremes(turned({"motion": table}), "disc.alpha")
    bends = CubicSpline(KNOTS, VALUES, bc_type="periodic")(KNOTS, 2)
    allowed = SOUGHT * np.ptp(bends)
    for low, high in ((peak.minimum, peak.maximum), (window[0], window[2])):
        assert low == pytest.approx(bends.min(), abs=allowed)
        assert high == pytest.approx(bends.max(), abs=allowed)


@pytest.mark.parametrize("knot", [0.08, 0.1312])
def test_the_largest_acceleration_is_that_just_behind_a_jump(knot: float) -> None:
    """An instant at a jump was taken to be before it and behind it: the jump was missed by 4e-4."""
    last = DURATION - knot
    # 0.9 rad/s^2 up to the knot, 54 rad/s^2 behind it, and from there on down to rest
    cubic = -(0.9 * knot + 2.0 * 27.0 * last) / (3.0 * last**2)
    pieces = [[0.0, 0.0, 0.45], [0.45 * knot**2, 0.9 * knot, 27.0, cubic]]
    motion = {"type": "piecewise-polynomial", "knots": [0.0, knot, DURATION], "outside": "held"}
    peak, window = extremes(turned({"motion": motion | {"coefficients": pieces}}), "disc.alpha")
    lowest = 54.0 + 6.0 * cubic * last
    allowed = SOUGHT * (54.0 - lowest)
    for low, high in ((peak.minimum, peak.maximum), (window[0], window[2])):
        assert low == pytest.approx(lowest, abs=allowed)
        assert high == pytest.approx(54.0, abs=allowed)


def test_a_force_over_whole_turns_is_largest_in_any_of_them() -> None:
    """Only the first turn and the last were looked at: a torque came to 0.76 for 2."""
    course = {"type": "table", "knots": [0.0, 15.0, 20.0], "values": [0.0, 2.0, -1.0]}
    torque = {"type": "torque", "moment": 1.0, "course": course | {"outside": "held"}}
    on_disc = {"first": "ground.O", "second": "disc.O", "over": {"quantity": "angle"}}
    scene = turned({"speed": 16.0 * math.pi})
    scene["forces"]["s"] = torque | on_disc
    peak, window = extremes(scene, "s.moment")
    assert (peak.minimum, window[0]) == pytest.approx((-1.0, -1.0))
    assert (peak.maximum, window[2]) == pytest.approx((2.0, 2.0), abs=SOUGHT)
    assert peak.maximum_time == pytest.approx(15.0 / (16.0 * math.pi), rel=1e-4)


def test_a_long_window_has_what_each_period_has() -> None:
    """Its instants were three in a period, always the same ones: a peak of 0.04 s was not seen."""
    bump = {"type": "table", "knots": [0.0, 0.1, 0.12, 0.14, 1.0], "values": [0.0, 0, 1.0, 0, 0]}
    torque = {"type": "torque", "moment": 3.0, "course": bump | {"outside": "periodic"}}
    scene = turned({"speed": 2.0 * math.pi})
    scene["forces"]["s"] = torque | {"first": "ground.O", "second": "disc.O"}
    long = 1333.0
    admission = admit({"kind": "simulate", "scene": scene, "duration": long, "output_step": 1.0})
    assert isinstance(admission, Admission)
    names = ["s.moment", "disc.theta"]
    moment, angle = ExactMotion(admission).extremes(names, np.array([0.0, long]))[0]
    assert (moment[0], moment[2]) == pytest.approx((0.0, 3.0), abs=3.0 * SOUGHT)
    assert (angle[0], angle[2]) == pytest.approx((0.0, 2.0 * math.pi * long))
