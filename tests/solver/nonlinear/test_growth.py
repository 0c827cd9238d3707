"""Exponents from growth factors alone: what is left out, what the error is, what is refused."""

import math

import numpy as np
import pytest

from jointplay.solver.nonlinear.lyapunov import exponent_from_growth
from tests.solver.nonlinear.exponents import agrees


@pytest.mark.parametrize("blocks", [20, 50, 200, 1000, 5000])
def test_growth_that_dies_out_is_not_taken_for_chaos(blocks: int) -> None:
    """Shear, as between neighbouring tori: the length grows like t, the exponent is zero."""
    time = np.arange(blocks + 1.0)
    found = exponent_from_growth(np.diff(np.log(np.hypot(1.0, time))), 1.0)
    assert not found.exceeds(0.0)
    assert found.drifting or blocks < 50


@pytest.mark.parametrize("before", [0, 10, 200, 10_000])
@pytest.mark.parametrize("blocks", [20, 100, 600])
def test_what_a_free_spin_adds_is_no_exponent(blocks: int, before: int) -> None:
    """Neighbours of a body that spins freely part by an angle that grows like t."""
    time = before + np.arange(blocks + 1.0)
    noise = 1e-9 * np.random.default_rng(before).standard_normal(blocks)
    found = exponent_from_growth(np.diff(np.log(np.hypot(0.3, time))) + noise, 0.1, before)
    assert found.value > 0.0
    assert found.value <= 1.1 * found.error
    # an exponent of its own is none the worse
    assert exponent_from_growth(np.full(blocks, 2.0) + noise, 1.0, before).error < 1e-8


def test_the_turning_of_the_vector_is_left_out() -> None:
    noise = 0.1 * np.random.default_rng(1).standard_normal(400)
    growth = noise + 0.5
    growth[:100] -= 3.0  # contracts at first, as while a weakly damped transient dies out
    found = exponent_from_growth(growth, 2.0)
    assert agrees(found, 0.25)
    assert found.error < 0.01


def test_a_turning_that_hides_in_the_ups_and_downs_is_left_out_too() -> None:
    """An approach to a torus: after the tenth nothing is left of it; no block stands out.

    Starting where the standard error is smallest would keep most of it, 2.6 errors.
    """
    time = np.arange(2000.0)
    growth = np.cos(2.0 * math.pi * 0.6180339887 * time) - np.exp(-time / 20.0)
    assert agrees(exponent_from_growth(growth, 1.0), 0.0, errors=1.0)


def test_the_unit_of_time_scales_the_exponent() -> None:
    growth = np.random.default_rng(2).standard_normal(300) + 0.3
    one, other = exponent_from_growth(growth, 1.0), exponent_from_growth(growth, 0.25)
    # powers of two scale exactly
    assert (other.value, other.error) == (4.0 * one.value, 4.0 * one.error)


def test_finer_blocks_of_the_same_growth_agree() -> None:
    fine = np.random.default_rng(3).standard_normal(4000) + 0.1
    coarse = fine.reshape(400, 10).sum(axis=1)
    one, other = exponent_from_growth(fine, 0.1), exponent_from_growth(coarse, 1.0)
    assert agrees(one, other.value, errors=0.5)
    assert one.error == pytest.approx(other.error, rel=0.3)  # each estimated from tens of batches


def test_a_transient_that_outlasts_the_record_shows_as_drift() -> None:
    growth = 0.5 * np.exp(-np.arange(300.0) / 200.0)
    assert exponent_from_growth(growth, 1.0).drifting


def test_few_blocks_are_worth_little() -> None:
    rng = np.random.default_rng(4)
    assert math.isnan(exponent_from_growth(np.empty(0), 1.0).value)
    assert exponent_from_growth(np.array([1.0]), 1.0).error == math.inf
    outside = sum(
        exponent_from_growth(rng.standard_normal(5), 1.0).falls_below(0.0)
        or exponent_from_growth(rng.standard_normal(5), 1.0).exceeds(0.0)
        for _ in range(200)
    )
    assert outside <= 4  # two tails of 0.3 %, twice 200 times


@pytest.mark.parametrize("growth", [[1.0, math.nan], [math.inf, 1.0]])
def test_growth_must_be_finite(growth: list[float]) -> None:
    with pytest.raises(ValueError, match="growth must be finite"):
        exponent_from_growth(np.array(growth), 1.0)


@pytest.mark.parametrize("block_time", [0.0, -1.0, math.inf, math.nan])
def test_blocks_take_time(block_time: float) -> None:
    with pytest.raises(ValueError, match="positive, finite time"):
        exponent_from_growth(np.ones(10), block_time)
