"""Whole turns that do not count: the cut lies where no points are."""

import numpy as np
import pytest

from jointplay.solver.nonlinear.settling import SETTLINGS, Settling
from jointplay.solver.nonlinear.whole_turns import unwound


def shaft(advance: float, count: int = 400) -> np.ndarray:
    """Return angle and speed of a shaft at sections, with the rounding of a run; (count, 2)."""
    sections = np.arange(count)
    noise = np.random.default_rng(3).normal(0.0, 1e-9, (2, count))
    return np.column_stack([0.3 + advance * sections, np.full(count, 2.0)]) + noise.T


@pytest.mark.parametrize("turns", [0.5, -0.5, 1.5, 0.25, 2.0 / 3.0, 5.0 / 8.0])
def test_a_shaft_with_a_ratio_is_back_after_its_turns(turns: float) -> None:
    states = shaft(2.0 * np.pi * turns)
    found = unwound(states, np.array([True, False]))
    assert np.ptp(found[::24, 0]) < 1e-7
    assert np.ptp(found[:, 0]) < 2.0 * np.pi
    assert found[0, 0] == states[0, 0]
    assert (found[:, 1] == states[:, 1]).all()


def test_such_a_shaft_settles_by_recurrence() -> None:
    settling = Settling(np.array([1e-4, 1e-4]), 1e-3, 400, np.array([True, False]))
    found = settling.feed(shaft(np.pi))
    assert found is not None
    assert found.code == SETTLINGS["recurrence"]
    assert "have period 2 within" in found.reason


def test_a_swing_is_left_as_it_is() -> None:
    states = shaft(0.0) + 3.1 * np.sin(np.arange(400.0))[:, None]
    assert (unwound(states, np.array([True, True])) == states).all()


def test_one_section_and_none() -> None:
    states = np.array([[7.0]])
    assert (unwound(states, np.array([True])) == states).all()
    assert unwound(np.zeros((0, 1)), np.array([True])).shape == (0, 1)
