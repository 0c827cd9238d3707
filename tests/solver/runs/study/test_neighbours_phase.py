"""A point that starts from its neighbour goes on at the same crank angle, wherever sections lie."""

import cmath
import math
from typing import Any

import numpy as np
import pytest

from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.restart_point import read, written
from tests.solver.runs.study.test_run import Computed

SPEED, AMPLITUDE, GAP, STIFFNESS, DAMPING = 28.0, 5e-3, 0.01, 400.0, 2.0
"""rad/s, m, m, N/m, N s/m, of 1 kg: it does not come to the stop."""
ANSWER = STIFFNESS * AMPLITUDE / (STIFFNESS - SPEED**2 + 1j * DAMPING * SPEED)  # m
SECTIONS = 150
DIAGRAM: dict[str, Any] = {
    "kind": "bifurcation",
    "scene": {"preset": "impact-oscillator", "parameters": {"speed": SPEED}},
    "parameter": "amplitude",
    "values": [AMPLITUDE, AMPLITUDE * (1.0 + 1e-9)],
    "continuation": "forward",
    "chains": 1,
    "settle": 0,
    "record": SECTIONS,
    "indicators": [],
    "observables": ["mass.x"],
    "tolerance": 1e-10,
}
POSITIONS = [
    ({"crank_angle": 0.0}, ANSWER.real),
    ({"crank_angle": 3.0}, (ANSWER * cmath.exp(3.0j)).real),
    ({"channel": "mass.vx", "value": 0.0, "direction": "up"}, -abs(ANSWER)),
]


@pytest.mark.parametrize(("section", "position"), POSITIONS)
def test_the_motion_goes_on_as_it_was(section: dict[str, Any], position: float) -> None:
    """The first point comes to the closed form of a linear motion; the second begins there."""
    found = Computed(DIAGRAM | {"section": section})
    assert len(found.sections(1)) == SECTIONS
    # 150 periods leave exp(-34) of the first point's start; the amplitude grows by 1e-9
    np.testing.assert_allclose(found.sections(1), position - GAP, rtol=0.0, atol=1e-9)
    assert found.ends[1].time == pytest.approx(found.ends[0].time, abs=2.0 * math.pi / SPEED)


def test_a_restart_point_keeps_where_a_waiting_point_starts() -> None:
    touching, rates = np.array([True, False]), np.array([0.3, 0.0])
    start = LaneStart(np.array([1.0, 2.0]), touching, rates, period=-1, time=0.125)
    ended, runs = read(written(0, [PointRun(1, 0, 1, start)], None, 0))
    assert ended == 0
    assert repr([run.start for run in runs]) == repr([start])
