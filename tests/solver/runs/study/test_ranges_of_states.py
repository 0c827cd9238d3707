"""Sections are compared with the range of each state where it is more than the clearance."""

import numpy as np
import pytest

from jointplay.solver.nonlinear.verdict import PERIODIC, UNDECIDED
from jointplay.solver.runs.study.indicators import Sections, indicators_of

TURNS, NONE = 100, np.zeros(0)


@pytest.mark.parametrize(
    ("spread", "noise", "period"),
    [(1000.0, 0.2, 2), (1.0, 0.2, 0), (1000.0, 2.0, 0), (0.0, 2e-4, 1)],
)
def test_noise_is_measured_beside_the_motion(spread: float, noise: float, period: int) -> None:
    chance = np.random.default_rng(7)
    rates = np.tile([0.0, spread], TURNS) + noise * chance.uniform(-1.0, 1.0, 2 * TURNS)
    states = np.column_stack([np.zeros(2 * TURNS), rates])
    flat = np.zeros(2, dtype=bool)
    sections = Sections(states, np.ones(2), flat, 1, 1.0)
    found, verdict = indicators_of(("recurrence",), sections, NONE, NONE, 1.0, 0)
    assert found["period"] == period
    assert verdict.code == (PERIODIC if period else UNDECIDED)


def test_a_creeping_state_does_not_recur_however_far_it_comes() -> None:
    states = np.linspace(0.0, 1000.0, 200)[:, None]
    sections = Sections(states, np.ones(1), np.zeros(1, dtype=bool), 1, 1.0)
    found, _ = indicators_of(("recurrence",), sections, NONE, NONE, 1.0, 0)
    assert found["period"] == 0
