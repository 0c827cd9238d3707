"""Motions that go round are quasi-periodic where their turns are those of a rigid rotation."""

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.indicators import Sections, indicators_of
from tests.solver.nonlinear.textbook import CAT, circle

RECORD, FINER = 600, 40
SCALE = 0.05
"""rad: what counts as one in the angle."""


def told(turns: Floats, rates: Floats, growth: Floats) -> dict[str, float]:
    """Return indicators of a shaft at angles, in turns, and of logarithms of the tangent."""
    angle = 2.0 * np.pi * np.concatenate([[turns[0]], turns[0] + np.cumsum(np.diff(turns) % 1.0)])
    states = np.stack([angle, rates], axis=1)
    sections = Sections(states, np.array([SCALE, SCALE]), np.array([True, False]), 1, 1.0)
    chosen = ["lyapunov", "recurrence", "zero_one", "rotation"]
    return indicators_of(chosen, sections, growth[:RECORD], growth[RECORD:], 1.0, 100)[0]


@pytest.mark.parametrize("rotation", [0.5 * (5.0**0.5 - 1.0), 2.0**0.5 - 1.0, 1.0 / np.pi])
def test_turns_of_a_circle_map_are_those_of_the_rotation_it_is_conjugate_to(rotation):
    orbit = circle(rotation, 0.4).orbit(RECORD + FINER, 100)[:, 0]
    growth = np.array([np.log(circle(rotation, 0.4).jacobian(x)[0, 0]) for x in orbit[:, None]])
    found = told(orbit[:RECORD], 2.0 + np.cos(2.0 * np.pi * orbit[:RECORD]), growth)
    assert found["rotation"] == pytest.approx(rotation, abs=1e-6)
    assert found["zero_one"] < 0.1
    assert found["verdict"] == VERDICTS["quasi-periodic"]


def test_chaos_that_goes_round_has_no_rotation_number():
    orbit = CAT.orbit(RECORD)
    found = told(orbit[:, 0], orbit[:, 1], np.full(RECORD + FINER, CAT.exponent))
    assert np.isnan(found["rotation"])
    assert found["verdict"] == VERDICTS["chaotic"]
