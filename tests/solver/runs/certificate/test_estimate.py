"""The estimate, the horizon and the spread, on numbers made up for it."""

import numpy as np
import pytest

from jointplay.solver.runs.certificate.companions import (
    LADDER,
    LOOSER,
    TIGHTER,
    TIGHTEST,
    TWIN,
)
from jointplay.solver.runs.certificate.estimate import (
    BINS,
    CONVERGED,
    LASTING,
    REACH,
    SAFETY,
    apart,
    around,
    histogram,
    last_small,
    near_claims,
    scales_from,
    spans,
    until,
    within,
)
from jointplay.solver.runs.certificate.instants import Instants

TIME = np.linspace(0.0, 1.0, 101)


def lanes(error: np.ndarray) -> np.ndarray:
    """Values of seven companions that are wrong in proportion to their tolerance; the last is the
    trajectory."""
    shares = np.array([*LADDER, 1.0, 1.0, 1.0])
    return np.sin(TIME)[None, :, None] + shares[:, None, None] * error[None, :, None]


def estimated_error(values: np.ndarray) -> np.ndarray:
    """Estimate where no law is steep."""
    return SAFETY * around(apart(values))


def test_an_error_in_proportion_to_the_tolerance_is_covered_and_not_overrated() -> None:
    error = 1e-6 * np.exp(8.0 * TIME)
    estimate = estimated_error(lanes(error))[:, 0]
    assert (estimate >= error).all()
    # a looser lane's share, and the growth to the last instant that counts
    assert (estimate <= SAFETY * np.exp(8.0 * REACH / 100.0) * error * 1.001).all()


def test_a_companion_left_behind_leaves_the_others() -> None:
    values = lanes(1e-6 * np.ones_like(TIME))
    values[0, 50:] = np.nan
    assert np.isfinite(estimated_error(values)).all()
    values[:, 80:] = np.nan
    estimate = estimated_error(values)[:, 0]
    assert np.isinf(estimate[80:]).all()
    assert np.isfinite(estimate[: 80 - REACH]).all()


def test_an_error_of_the_trajectory_alone_is_covered() -> None:
    values = lanes(np.zeros_like(TIME))
    values[TWIN - 1, 60] += 1e-3
    assert estimated_error(values)[60, 0] >= 1e-3


def test_where_tighter_companions_were_left_behind_looser_ones_tell_the_error() -> None:
    error = 1e-6 * np.exp(8.0 * TIME)
    values = lanes(error)
    values[[TIGHTEST - 1, TIGHTER - 1]] = np.nan
    assert (estimated_error(values)[:, 0] >= error).all()
    values[[lane - 1 for lane in LOOSER]] = np.nan  # what is left has one tolerance
    assert np.isinf(estimated_error(values)).all()


def test_instants_count_that_reach_into_what_is_claimed() -> None:
    errors = np.zeros((101, 1))
    errors[60] = 1.0
    near = near_claims(errors, np.array([1.0]))
    # instants within REACH of the error claim nothing, but count for those that do
    assert np.flatnonzero(~near).tolist() == [60]
    assert not near_claims(errors + 1.0, np.array([1.0])).any()


def test_the_horizon_is_the_first_loss_and_later_spans_must_last() -> None:
    error = np.zeros((101, 1))
    error[30:50] = error[53:60] = 1.0  # instants 50 to 52 are a chance meeting
    scales = np.full((101, 1), 1.0 / CONVERGED / 2.0)
    small = within(error, scales)
    assert until(error, scales, TIME) == pytest.approx(0.29)
    assert last_small(error, scales) == 29
    assert spans(small, TIME) == [[0.0, pytest.approx(0.29)], [pytest.approx(0.6), 1.0]]
    assert LASTING > 3
    assert spans(np.zeros((101, 1), bool), TIME) == [[0.0, 0.0]]
    assert spans(np.ones((101, 1), bool), TIME) == [[0.0, 1.0]]


def test_errors_are_small_against_what_was_reached_by_then() -> None:
    reached = np.exp(20.0 * TIME)[:, None]  # a run that blows up, by far more than its motion
    assert last_small(0.04 * reached, reached) == 100
    assert last_small(0.06 * reached, reached) == 0
    kept = last_small(np.full((101, 1), 0.05 * np.exp(10.0)), reached)
    assert kept == 100  # what was wrong in between is small against all until the end
    error = 0.06 * reached
    error[:50] = 0.0
    assert last_small(error, reached) == 49
    scales = scales_from(reached, 49)
    assert (scales[:50] == reached[49]).all()
    assert (scales[50:] == reached[50:]).all()


def test_no_error_is_small_that_is_infinite() -> None:
    assert not within(np.array([[np.inf]]), np.array([np.inf])).any()


def test_shares_of_time_add_up_and_equal_lanes_have_no_spread() -> None:
    values = np.repeat(np.sin(7.0 * TIME)[None, :, None], 7, axis=0)
    edges, share, spread = histogram(values, TIME)
    assert share.sum() == pytest.approx(1.0)
    assert np.abs(spread).max() == pytest.approx(0.0, abs=1e-15)
    assert len(edges) == BINS + 1
    assert edges[[0, -1], 0].tolist() == [values.min(), values.max()]
    values[3:] *= -0.5
    assert histogram(values, TIME)[2].max() > 0.0


@pytest.mark.parametrize("periods", [0.5, 1, 8, 16, 60, 64, 64.2, 256, 1000, 2**20])
def test_a_histogram_is_that_of_the_motion_however_its_period_divides_the_run(periods):
    """Shares of a sine beside those of samples that are thousands of times closer."""
    time = Instants.over(periods, 1.0).time
    edges, share, _ = histogram(np.sin(2.0 * np.pi * time)[None, :, None], time)
    fine = np.sin(2.0 * np.pi * np.linspace(0.0, min(periods, 100.0), 1_000_000))
    true = np.histogram(fine, edges[:, 0])[0] / len(fine)
    assert np.abs(share[:, 0] - true).max() < 0.05
