"""Coverage of what fits equally well, of readings that are linear in a parameter."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.calibration_coverage import coverage

FACTOR = 1.2


def document(readings: int, cost: float, **fields: Any) -> dict[str, Any]:
    limit = max(FACTOR * cost, 1.0)
    target = {"weight": 1.0, "between": None} | fields
    return {"cost": cost, "equally_good_cost": limit, "targets": [target] * readings}


@pytest.mark.parametrize(
    ("readings", "known"), [(1, 0.68), (2, 0.77), (5, 0.90), (10, 0.97), (20, 1.0), (100, 1.0)]
)
def test_it_is_how_often_noisy_readings_leave_the_true_value_in_the_range(
    readings: int, known: float
) -> None:
    """Readings of one number: their mean fits best, and costs grow with the distance from it."""
    errors = np.random.default_rng(1).standard_normal((20_000, readings))
    costs, off = errors.std(axis=1), np.abs(errors.mean(axis=1))
    limits = np.maximum(FACTOR * costs, 1.0)
    covered = np.mean(np.sqrt(costs**2 + off**2) <= limits)
    told = [coverage(document(readings, float(cost))) for cost in costs]
    assert covered == pytest.approx(known, abs=0.01)
    assert np.mean(np.array(told)) == pytest.approx(covered, abs=0.01)


@pytest.mark.parametrize("fields", [{"between": [1.0, 2.0]}, {"weight": 0.0}])
def test_of_ranges_or_of_nothing_fitted_it_is_not_told(fields: dict[str, Any]) -> None:
    assert coverage(document(3, 0.5, **fields)) is None


def test_targets_that_are_only_shown_do_not_count() -> None:
    found = document(2, 0.5)
    shown = {"weight": 0.0, "between": [1.0, None]}
    assert coverage(found | {"targets": [*found["targets"], shown]}) == coverage(found)


def test_of_different_weights_it_is_not_told() -> None:
    found = document(2, 0.5)
    assert (
        coverage(found | {"targets": [*found["targets"], {"weight": 2.0, "between": None}]}) is None
    )
