"""Errors of shares against the definition of the interval that they are of."""

import numpy as np
import pytest

from jointplay.records.share_error import share_error


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
