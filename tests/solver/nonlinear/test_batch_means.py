"""Errors of means: as large as the scatter of the means of many records."""

import math

import numpy as np
import pytest

from jointplay.solver.nonlinear.batch_means import mean_estimate, standard_error
from jointplay.solver.nonlinear.estimate import Estimate
from tests.solver.nonlinear.exponents import agrees

RECORDS = 300


def correlated(memory: float, count: int, seed: int) -> np.ndarray:
    """Return RECORDS stationary first-order autoregressive series of mean 0, (count, RECORDS)."""
    noise = np.random.default_rng(seed).standard_normal((count, RECORDS))
    series = np.empty_like(noise)
    series[0] = noise[0] / math.sqrt(1.0 - memory**2)
    for i in range(1, count):
        series[i] = memory * series[i - 1] + noise[i]
    return series


@pytest.mark.parametrize("memory", [-0.6, 0.0, 0.5, 0.9, 0.97])
@pytest.mark.parametrize("count", [400, 2000])
def test_three_errors_hold_the_true_mean(memory: float, count: int) -> None:
    series = correlated(memory, count, seed=count)
    outside = np.abs(series.mean(axis=0)) > 3.0 * standard_error(series)
    # 0.3 % is expected; the longest memory is 33 numbers, a twelfth of the shorter record
    assert outside.mean() <= 0.02


def test_few_batches_are_worth_less() -> None:
    """Eight batches of eight numbers: beyond three errors lie 0.3 %, not Student's 2.4 %."""
    series = np.random.default_rng(9).standard_normal((64, 4000))
    outside = np.abs(series.mean(axis=0)) > 3.0 * standard_error(series)
    assert outside.mean() < 0.006  # 0.27 % of 4000 is 11 ± 3


@pytest.mark.parametrize("memory", [-0.6, 0.0, 0.5, 0.9])
def test_errors_are_no_larger_than_they_need_be(memory: float) -> None:
    series = correlated(memory, 2000, seed=5)
    true = 1.0 / ((1.0 - memory) * math.sqrt(2000.0))
    # the widening and the correction for few batches make it a little larger: up to 1.3 here
    assert true * 0.9 < np.median(standard_error(series)) < true * 1.5


def test_taking_correlated_numbers_as_independent_would_be_wrong() -> None:
    series = correlated(0.9, 2000, seed=6)
    naive = series.std(axis=0) / math.sqrt(2000.0)
    assert (np.abs(series.mean(axis=0)) > 3.0 * naive).mean() > 0.3


def test_columns_do_not_influence_each_other() -> None:
    series = correlated(0.9, 500, seed=7)[:, :4] * [1.0, 1e-9, 1e9, 0.0]
    together = standard_error(series)
    alone = [float(standard_error(series[:, [i]])[0]) for i in range(4)]
    assert together == pytest.approx(alone, rel=1e-13)  # sums of other shapes round otherwise
    assert together[3] == 0.0


def test_a_drift_is_seen_and_covered_by_the_error() -> None:
    noise = np.random.default_rng(8).standard_normal(1000)
    steady, drifting = mean_estimate(noise), mean_estimate(noise + np.linspace(0.0, 2.0, 1000))
    assert not steady.drifting
    assert drifting.drifting
    assert drifting.error > 0.8  # the halves differ by 1


def test_records_too_short_say_so() -> None:
    assert math.isnan(mean_estimate(np.empty(0)).value)
    assert mean_estimate(np.array([2.0, 4.0])) == Estimate(3.0, math.inf)
    assert mean_estimate(np.array([2.0, 4.0, 3.0])).error > 1.0


def test_an_error_is_never_negative() -> None:
    with pytest.raises(ValueError, match="zero, positive or infinite, not -1"):
        Estimate(1.0, -1.0)
    with pytest.raises(ValueError, match="not nan"):
        Estimate(1.0, math.nan)


@pytest.mark.parametrize(
    ("estimate", "words"),
    [
        (Estimate(0.5834, 0.0521), "0.583 ± 0.052"),
        (Estimate(123.4, 25.0), "123 ± 25"),
        (Estimate(math.log(2.0), 2e-16), "0.693147 ± 2e-16"),
        (Estimate(-math.inf, 0.0), "-inf ± 0"),
        (Estimate(1.0, math.inf), "1 ± inf"),
    ],
)
def test_an_estimate_reads_like_a_measurement(estimate: Estimate, words: str) -> None:
    assert str(estimate) == words


def test_comparisons_count_errors() -> None:
    estimate = Estimate(1.0, 0.3)
    assert estimate.exceeds(0.0)
    assert not estimate.exceeds(0.2)
    assert estimate.falls_below(2.0)
    assert agrees(estimate, 1.5)
    unknown = Estimate(1.0, math.inf)
    assert not unknown.exceeds(0.0)
    assert not unknown.falls_below(5.0)
