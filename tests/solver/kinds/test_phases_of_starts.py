"""Attractors of starts that differ in the phase of the drive: told apart where it stands alike."""

import cmath
from typing import Any

import numpy as np
import pytest

from jointplay.local import run
from jointplay.records.attractors import attractors_of
from tests.solver.runs.study.test_run import Computed

SPEED, AMPLITUDE, GAP, STIFFNESS, DAMPING = 28.0, 5e-3, 0.05, 400.0, 2.0
"""rad/s, m, m, N/m, N s/m, of 1 kg: it does not come to the stop."""
PHASES = [0.0, 1.0, 2.5, -3.0, 7.0]
BASINS: dict[str, Any] = {
    "kind": "basins",
    "along": {"start": "/drivers/motor/position", "values": PHASES},
    "by": {"start": "/start/joints/stop/rate/0", "values": [0.0]},
    "settle": 90,
    "record": 8,
    "indicators": ["recurrence"],
}


@pytest.mark.parametrize("angle", [0.0, 1.0])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_sections_are_where_the_drive_stands_alike(angle: float, sense: float) -> None:
    """A linear motion has one answer to the drive, whichever phase that begins with."""
    speed = sense * SPEED
    scene = {"preset": "impact-oscillator", "parameters": {"gap": GAP, "speed": speed}}
    found = Computed(BASINS | {"scene": scene, "section": {"crank_angle": angle}})
    answer = STIFFNESS * AMPLITUDE / (STIFFNESS - SPEED**2 + 1j * DAMPING * SPEED)
    place = (answer * cmath.exp(1j * angle)).real - GAP
    means = [found.ends[k].statistics["cycle_mean.mass.s"] for k in range(len(PHASES))]
    # exp(-20) of 0.1 m is left of the start; the stop is at the origin
    np.testing.assert_allclose(means, place, rtol=0.0, atol=1e-8)


def test_drawn_phases_end_on_as_many_attractors_as_there_are() -> None:
    """Two motions of one period coexist: one strikes the stop in each, the other never."""
    drawn = {
        "kind": "basin-stability",
        "scene": {"preset": "impact-oscillator", "parameters": {"speed": SPEED}},
        "starts": {
            "/drivers/motor/position": {"distribution": "uniform", "low": 0.0, "high": 6.283},
            "/start/joints/stop/rate/0": {"distribution": "uniform", "low": -0.5, "high": 0.5},
        },
        "samples": 24,
        "settle": 90,
        "record": 8,
        "indicators": ["recurrence"],
        "statistics": ["impacts"],
        "tolerance": 1e-6,
    }
    study = run(drawn, processes=1).study()
    names = {one.code: one.name for one in attractors_of(study).found}
    strikes = study.statistics["stop.impacts"] > 0.0
    labels = attractors_of(study).labels
    assert sorted(names.values()) == ["period-1 A", "period-1 B"]
    assert len({*zip(labels.tolist(), strikes.tolist(), strict=True)}) == 2
