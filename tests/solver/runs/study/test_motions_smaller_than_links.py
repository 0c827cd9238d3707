"""Motions that are small beside what counts as one, where that is no clearance."""

from typing import Any

import numpy as np
import pytest

from benchmarks.basin_scenes import cubic_oscillator, shaking
from jointplay.local import run
from jointplay.solver.nonlinear.recurrence import moves_within
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.indicators import Sections, indicators_of

COUNT = 60


def logistic(growth: float) -> Any:
    """Return (COUNT,) iterates of x -> growth x (1 - x) behind a transient."""
    x = [0.3]
    for _ in range(500 + COUNT):
        x.append(growth * x[-1] * (1.0 - x[-1]))
    return np.array(x[-COUNT:])


def two_wells(size: float, push: float) -> dict[str, Any]:
    """Return u'' = -0.2 u' + u - u^3 + push cos(t), of u in so many metres."""
    scene = cubic_oscillator(0.2, -1.0, shaking=shaking(push * size))
    scene["forces"]["spring"]["course"]["coefficients"][3] = -1.0 / size**2
    return scene | {"start": {"points": {"mass.centre": [size, 0.0]}}}


@pytest.mark.parametrize(
    ("size", "push", "verdict"),
    [(1.0, 0.3, "undecided"), (1e-4, 0.3, "undecided"), (1e-4, 0.1, "periodic")],
)
def test_a_small_motion_is_not_periodic_for_being_small(size, push, verdict):
    """At 0.3 it is chaotic: SciPy's DOP853 has an exponent of 0.15 1/s, whatever the size."""
    job = {"kind": "poincare", "scene": two_wells(size, push), "settle": 60, "record": COUNT}
    study = run(job | {"indicators": ["recurrence"]}, processes=1).study()
    assert study.verdict_names[study.verdicts[0]] == verdict
    if size < 1.0 and push == 0.3:
        assert "move in no order" in study.reasons[0]
    assert "less than 0.001 of 1 m, as there is no link, or of its own range" in study.reasons[0]


@pytest.mark.parametrize(
    ("motion", "moves"),
    [
        (8e-4 * logistic(3.9), True),
        (8e-4 * logistic(3.2), False),  # of period 2
        (4e-4 * 0.9 ** np.arange(COUNT) * np.cos(np.arange(COUNT)), False),
        (4e-4 * np.cos(np.arange(COUNT)), True),
        (2e-5 * logistic(3.9), False),  # noise
    ],
)
def test_what_moves_in_no_order_and_does_not_fade_is_no_orbit(motion, moves):
    states = np.column_stack([motion, np.roll(motion, 1)])[1:]
    assert moves_within(states, 1e-3) == moves
    for has_play in (True, False):
        sections = Sections(states, np.ones(2), np.zeros(2, np.bool_), 1, 1.0, has_play)
        _, verdict = indicators_of(("recurrence",), sections, np.zeros(0), np.zeros(0), 1.0, 0)
        undecided = moves and not has_play
        assert verdict.code == VERDICTS["undecided" if undecided else "periodic"]
