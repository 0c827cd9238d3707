"""A pendulum that hangs at rest on a shaken pivot: branches begin where that is unstable."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from benchmarks.known_orbits import followed

GRAVITY, DAMPING = 9.81, 0.05
"""m/s², N m s; the rod has 1 kg and 1 m."""


def job(frequency: float, low: float, high: float, **fields: int) -> dict[str, Any]:
    """A branch over the amplitude of shaking, m, from the rod at rest."""
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"pin": [-0.5, 0.0], "tip": [0.5, 0.0]}}
    shaking = {"type": "sinusoidal", "amplitude": low, "frequency": frequency}
    scene = {
        "name": "shaken-pendulum",
        "gravity": [0.0, -GRAVITY],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "pivot": {"mass": 1.0, "inertia": 1.0, "points": {"pin": [0.0, 0.0]}},
            "rod": rod,
        },
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "pivot.pin",
                "axis": [0.0, 1.0],
            },
            "pin": {"type": "revolute", "bearing": "pivot.pin", "journal": "rod.pin"},
        },
        "drivers": {"shaker": {"joint": "guide", "motion": shaking}},
        "forces": {
            "damper": {
                "type": "torsion-spring",
                "first": "ground.O",
                "second": "rod.pin",
                "damping": DAMPING,
            }
        },
        "start": {"angles": {"rod": -0.5 * math.pi}},
        "parameters": {
            "shake": {
                "help": "Amplitude of the pivot.",
                "unit": "m",
                "default": low,
                "targets": [{"path": "/drivers/shaker/motion/amplitude"}],
            }
        },
    }
    values = {"from": low, "to": high, "count": 60}
    return {
        "kind": "continuation",
        "scene": scene,
        "parameter": "shake",
        "values": values,
        "settle": 5,
        **fields,
    }


def known(frequency: float, multiplier: float, low: float, high: float) -> float:
    """The amplitude, m, where the linear motion about rest has a multiplier, by integration."""

    def condition(amplitude: float) -> float:
        def slopes(t: float, z: np.ndarray) -> list[float]:
            lift = GRAVITY - amplitude * frequency**2 * math.sin(frequency * t)
            pull = [-3.0 * (DAMPING * z[k + 1] + 0.5 * lift * z[k]) for k in (0, 2)]
            return [z[1], pull[0], z[3], pull[1]]

        period = 2.0 * math.pi / frequency
        run = solve_ivp(slopes, (0.0, period), [1, 0, 0, 1], "DOP853", rtol=1e-12, atol=1e-13)
        return float(np.linalg.det(run.y[:, -1].reshape(2, 2) - multiplier * np.eye(2)))

    return brentq(condition, low, high, xtol=1e-12)


def test_symmetric_branches_begin_where_a_multiplier_is_one() -> None:
    first, other = followed(job(3.8, 0.2, 0.3, branch_points=1))
    (point,) = [one for one in first.special if one.label == "BP"]
    # the bound is of locating it, without the error of runs at 1e-11
    assert point.value == pytest.approx(known(3.8, 1.0, 0.2, 0.3), abs=point.bound + 1e-9)
    assert point.bound < 1e-9
    assert [one.label for one in other.special] == ["BP", "EP", "EP"]
    angle = other.column("state.rod.theta") + 0.5 * math.pi
    ends = angle[[one.row for one in other.special[1:]]]
    assert abs(ends[0]) > 0.2
    # mirror images at the end of the range; runs at 1e-11
    assert ends[0] == pytest.approx(-ends[1], abs=1e-8)


def test_orbits_of_twice_the_period_begin_where_a_multiplier_is_minus_one() -> None:
    first, other = followed(job(7.6, 0.005, 0.1, doublings=1))
    (point,) = [one for one in first.special if one.label == "PD"]
    assert point.value == pytest.approx(known(7.6, -1.0, 0.005, 0.1), abs=point.bound + 1e-9)
    assert point.bound < 1e-9
    (fold,) = [one for one in other.special if one.label == "LP"]
    # by Newton's method on runs of DOP853 at 1e-13, of the orbit and det(D - 1) = 0
    assert fold.value == pytest.approx(0.013342483942, abs=1e-11)
    assert np.abs(other.column("state.rod.theta") + 0.5 * math.pi).max() > 0.8
