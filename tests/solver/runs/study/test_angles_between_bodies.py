"""An angle between two bodies crosses a value once in each turn, as the angle of a body does."""

import math
from typing import Any

import numpy as np
import pytest

from tests.solver.runs.study.test_run import Computed

RATES = {"a": -2.0 * math.pi, "b": 2.0 * math.pi}
APART: dict[str, Any] = {
    "name": "apart",
    "ground": {"points": {"A": [0.0, 0.0], "B": [1.0, 0.0]}},
    "bodies": {
        name: {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0]}} for name in RATES
    },
    "joints": {
        "ja": {"type": "revolute", "bearing": "ground.A", "journal": "a.O"},
        "jb": {"type": "revolute", "bearing": "ground.B", "journal": "b.O"},
    },
    "forces": {
        "meas": {"type": "torsion-spring", "first": "a.O", "second": "b.O", "stiffness": 0.0},
    },
    "start": {"angular_velocities": RATES},
    "period": 10.0,
}  # fmt: skip


@pytest.mark.parametrize(
    ("channel", "rate"), [("b.theta", 2.0 * math.pi), ("meas.angle", 4.0 * math.pi)]
)
def test_a_section_at_an_angle_is_taken_in_each_turn(channel: str, rate: float) -> None:
    section = {"channel": channel, "value": 1.0}
    job = {"kind": "poincare", "scene": APART, "section": section, "settle": 0, "record": 4}
    found = Computed({**job, "observables": ["b.theta"]}).sections(0)[:, 0]
    times = (1.0 + 2.0 * math.pi * np.arange(4)) / rate
    assert found == pytest.approx(times * RATES["b"], abs=1e-9)
