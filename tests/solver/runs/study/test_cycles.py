"""Means and spreads over a cycle do not depend on where the record ends."""

import numpy as np
import pytest

from jointplay.records.cycles import INDEPENDENT
from jointplay.solver.runs.study.cycles import cycle_of, independent

ANGLES = np.array([True, False])
ONE = np.array([1e-4, 1e-3])
NAMES = ["rod.theta"]


def turning(first):
    """Return sections of a cycle of three, a third of a turn apart, from one of them."""
    angles = np.array([0.3, 2.3, 4.4])[(first + np.arange(12)) % 3]
    wound = angles - 2.0 * np.pi * np.round((angles - angles[0]) / (2.0 * np.pi))
    return np.stack([wound, np.cos(angles)], axis=1)


def test_a_cycle_that_goes_round_is_the_same_from_each_of_its_sections():
    first, *others = (cycle_of(NAMES, turning(first), ONE, ANGLES, 3) for first in range(3))
    del first[INDEPENDENT]
    for other in others:
        assert {name: other[name] for name in first} == pytest.approx(first, abs=1e-12)


def test_a_narrow_cycle_has_the_mean_and_the_spread_of_its_angles():
    angles = 3.14 + np.array([0.0, 0.02, 0.0, 0.02])
    found = cycle_of(NAMES, np.stack([angles, angles], axis=1), ONE, ANGLES, 2)
    assert found["cycle_mean.rod.theta"] == pytest.approx(3.15 - 2.0 * np.pi, abs=1e-9)
    assert found["cycle_spread.rod.theta"] == pytest.approx(0.01, rel=1e-4)
    assert np.isnan(found[INDEPENDENT])


@pytest.mark.parametrize("centre", [0.7, 3.1, -300.0])
def test_the_spread_of_an_angle_has_no_floor_of_rounding(centre):
    """A micrometre of play in a metre of link: attractors are told apart at 2e-9 rad."""
    angles = centre + np.array([1e-9, -1e-9] * 8)
    found = cycle_of(NAMES, np.stack([angles, angles], axis=1), ONE, ANGLES, 2)
    assert found["cycle_spread.rod.theta"] == pytest.approx(1e-9, rel=1e-3)
    still = cycle_of(NAMES, np.full((16, 2), centre), ONE, ANGLES, 1)
    assert still["cycle_spread.rod.theta"] < 1e-12


def test_sections_that_depend_on_those_before_count_for_fewer():
    """An autoregression of lag one, phi: of n sections (1 - phi) / (1 + phi) are independent."""
    generator = np.random.default_rng(5)
    found = []
    for phi in (0.0, 0.9):
        values = np.zeros((4000, 2))
        for k in range(1, 4000):
            values[k] = phi * values[k - 1] + generator.standard_normal(2)
        found.append(independent(values, np.zeros(2, np.bool_)))
    # batch means of 8 batches err by a half, and the largest of four columns counts
    assert 4000 / 4 < found[0] <= 4000
    assert 4000 / 19 / 4 < found[1] < 4000 / 19 * 2


def test_what_only_rounds_does_not_depend_on_the_sections_before():
    """The angle of a shaft behind gears is that of its drive, but for rounding that grows."""
    rate = np.random.default_rng(7).standard_normal(400)
    shaft = 0.3 + 1e-13 * np.arange(400)
    found = cycle_of(NAMES, np.column_stack([shaft, rate]), ONE, ANGLES, 0)
    assert found[INDEPENDENT] > 400 / 4


def test_too_few_sections_tell_no_scatter_and_none_no_place():
    assert np.isnan(independent(np.zeros((15, 2)), ANGLES))
    assert np.isnan(cycle_of(NAMES, np.zeros((0, 2)), ONE, ANGLES, 0)["cycle_mean.rod.theta"])
