"""Neimark-Sacker bifurcations over a second parameter, of a motion that is known exactly."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from benchmarks.known_orbits import followed
from benchmarks.limit_cycles import SHARP, SPRING, over_speed
from jointplay.records.branch import SECOND, SECOND_BOUND

CUBE = 0.3
"""N s^3/m^3, of x'' = push x' - CUBE x'^3 / 3 - stiffness x and the force that makes x = sin t."""
AT = CUBE / 2.0
"""Push at which speeds beside neither grow nor decay: CUBE times the mean square of the speed."""


def of_one_sine() -> dict[str, Any]:
    """Return the oscillator; its force grows with both parameters, that sin t stays its motion."""
    sine = {"type": "sinusoidal", "amplitude": 1.0, "frequency": 1.0}
    in_step = {"type": "force", **ON_THE_MASS, "direction": [1.0, 0.0], "course": sine}
    forces = {
        "spring": SPRING,
        "push": over_speed([0.0, 1.0]),
        "cube": over_speed([0.0, 0.0, 0.0, -CUBE / 3.0]),
        "against_inertia": in_step | {"magnitude": -1.0},
        "against_spring": in_step | {"magnitude": 1.0},
        "against_push": shaking(1.0),
        "against_cube": shaking(CUBE / 4.0),
        "against_its_wave": shaking(CUBE / 12.0, 3.0),
    }
    targets = {
        "push": {"/forces/push/magnitude": 1.0, "/forces/against_push/magnitude": -1.0},
        "stiffness": {"/forces/spring/stiffness": 1.0, "/forces/against_spring/magnitude": 1.0},
    }
    values, units = {"push": 0.14, "stiffness": 1.3}, {"push": "N s/m", "stiffness": "N/m"}
    parameters = {
        name: {"help": name, "unit": units[name], "default": values[name]}
        | {"targets": [{"path": path, "factor": factor} for path, factor in paths.items()]}
        for name, paths in targets.items()
    }
    return sliding("one-sine", 1e-13, **forces) | {"parameters": parameters}


def stiffness_at(cosine: float, low: float, high: float) -> float:
    """Return the stiffness at which the pair on the unit circle has an angle, by its equation."""

    def away(stiffness: float) -> float:
        def slope(t: float, y: Any) -> list[float]:
            gain = AT - CUBE * math.cos(t) ** 2
            return [y[1], gain * y[1] - stiffness * y[0], y[3], gain * y[3] - stiffness * y[2]]

        end = solve_ivp(slope, (0.0, 2.0 * math.pi), [1.0, 0.0, 0.0, 1.0], **SHARP).y[:, -1]
        return float(end[0] + end[3]) / 2.0 - cosine

    return brentq(away, low, high, xtol=1e-10)


def test_a_pair_stays_on_the_unit_circle_from_one_resonance_to_the_next() -> None:
    values = {"from": 1.0, "to": 1.9, "count": 20}
    second = {"parameter": "stiffness", "values": values, "labels": ["NS"], "curves": 1}
    values = {"from": 0.14, "to": 0.16, "count": 12}
    job = {"scene": of_one_sine(), "parameter": "push", "values": values, "second": second}
    first, curve = followed(job | {"largest_step": 0.1})
    (start,) = [one for one in first.special if one.label == "NS"]
    assert abs(start.value - AT) <= start.bound + 1e-10  # and of runs at their tolerance
    assert curve.of == "NS"
    assert (np.abs(curve.column("value") - AT) <= curve.column("bound") + 1e-8).all()
    assert not curve.column("unstable").any()  # the pair is not counted
    real, imaginary = (curve.column(f"multiplier_1.{part}") for part in ("real", "imaginary"))
    assert np.hypot(real, imaginary) == pytest.approx(1.0, abs=1e-6)
    named = {one.label: one for one in curve.special}
    assert [one.label for one in curve.special if one.label[0] == "R"] == ["R4", "R3", "R1"]
    for label, cosine, reach in (
        ("R4", 0.0, (1.5, 1.7)),
        ("R3", -0.5, (1.7, 1.9)),
        ("R1", 1.0, (1.05, 1.2)),
    ):
        one = named[label]
        assert one.second is not None
        assert one.second_bound is not None
        assert abs(one.second - stiffness_at(cosine, *reach)) <= one.second_bound + 1e-8
        assert one.second_bound < 1e-4
    assert curve.column(SECOND).min() == named["R1"].second
    assert curve.column(SECOND_BOUND).max() == named["R1"].second_bound
