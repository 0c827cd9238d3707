"""Exponents of a study's points: what tangent vectors give, and what they leave alone."""

import math
from typing import Any

import numpy as np

from tests.solver.completed_runs import CASE_3
from tests.solver.runs.study.test_run import Computed

DIAGRAM: dict[str, Any] = {
    "kind": "bifurcation",
    "scene": {"preset": "seven-bar-press", "parameters": CASE_3},
    "parameter": "dynamic_velocity",
    "values": [1e-3, 1e-2],
    "settle": 1,
    "record": 8,
}


def test_exponents_change_no_section_and_are_not_known_where_friction_jumps() -> None:
    with_exponents = Computed({**DIAGRAM, "indicators": ["lyapunov"]})
    without = Computed(DIAGRAM)
    for point in range(2):
        assert with_exponents.ends[point].code == ""
        assert np.array_equal(with_exponents.sections(point), without.sections(point))
    # the static velocity is 1e-3, too
    jump, ramp = (with_exponents.ends[point].indicators for point in range(2))
    assert math.isnan(jump["lyapunov"])
    # eight revolutions tell little: a regular motion (-0.09 at tighter tolerances), and an error
    # that depends on how a single step happens to pass a kink of friction
    assert -0.2 < ramp["lyapunov"] < 0.0
    assert abs(ramp["lyapunov"]) < ramp["lyapunov_error"] < 10.0


def test_a_fast_press_is_chaotic_by_its_exponent() -> None:
    scene = {
        "preset": "seven-bar-press",
        "parameters": CASE_3 | {"speed": 7.854, "speed_crank4": -7.854},
    }
    job = {"kind": "poincare", "scene": scene, "settle": 20, "record": 100}
    end = Computed({**job, "indicators": ["lyapunov"]}).ends[0]
    # 6.9 +- 0.1 over longer runs at tolerances down to 1e-11; over these hundred periods 5.9 to
    # 7.1 with errors of 0.45 to 0.75, at tolerances from 1e-6 to 1e-9
    assert abs(end.indicators["lyapunov"] - 6.9) < 1.5
    assert 0.2 < end.indicators["lyapunov_error"] < 1.0
