"""Errors of shares against the definition of the interval that they are of."""

import numpy as np
import pytest

from jointplay.records.share_error import error_of_starts, share_error


@pytest.mark.parametrize(("count", "trials"), [(0, 1), (1, 1), (3, 8), (200, 200), (7, 4000)])
def test_it_is_half_of_wilsons_interval(count: int, trials: int) -> None:
    """Its ends are the shares p for which the one that is found is a standard deviation away."""
    found = count / trials
    low, high = sorted(np.roots([1 + 1 / trials, -2 * found - 1 / trials, found**2]))
    assert share_error(count, trials) == pytest.approx((high - low) / 2, rel=1e-9)


def test_many_trials_have_the_binomial_error_and_none_has_no_number() -> None:
    errors = share_error(np.array([300_000, 0]), np.array([1_000_000, 0]))
    assert errors[0] == pytest.approx(np.sqrt(0.3 * 0.7 / 1e6), rel=1e-5)
    assert np.isnan(errors[1])


def test_starts_that_are_tried_once_are_independent_trials() -> None:
    counts = np.array([1, 0, 0, 1, 0, 0, 0])
    trials = np.array([1, 1, 1, 1, 1, 0, 1])
    assert error_of_starts(counts, trials) == pytest.approx(float(share_error(2, 6)), rel=1e-12)
    assert np.isnan(error_of_starts(np.array([], int), np.array([], int)))


def test_starts_that_end_alike_at_every_value_are_no_more_for_being_tried_often() -> None:
    once = np.array([1, 0, 0, 1, 0, 0, 0, 0])
    often = error_of_starts(17 * once, np.full(8, 17))
    assert often == pytest.approx(float(share_error(2, 8)), rel=1e-12)


def test_the_error_of_starts_over_a_parameter_is_that_of_shares_drawn_again() -> None:
    """A start changes over at a value of its own; the mean share over 17 values is drawn 400 times.

    As independent trials all values together would have 0.41 of the error.
    """
    generator = np.random.default_rng(4)
    values = np.arange(1, 18)
    shares, errors = [], []
    for _ in range(400):
        changes = 20.0 * generator.random(100)
        counts = (values[None, :] < changes[:, None]).sum(axis=1)
        shares.append(counts.mean() / 17)
        errors.append(error_of_starts(counts, np.full(100, 17)))
    assert np.mean(errors) == pytest.approx(np.std(shares), rel=0.1)
    assert share_error(750, 1700) < 0.5 * np.mean(errors)
    within = np.abs(np.array(shares) - np.mean(shares)) < errors
    assert np.mean(within) == pytest.approx(0.683, abs=0.06)
