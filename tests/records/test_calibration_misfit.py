"""Calibrations in which nothing fits, or whose best set lies at the end of a range."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.calibration_misfit import best_at, misfits, with_misfits


def document(readings: int, cost: float) -> dict[str, Any]:
    target = {"weight": 1.0, "between": None}
    limit = max(1.2 * cost, 1.0)
    return {"cost": cost, "equally_good_cost": limit, "targets": [target] * readings}


@pytest.mark.parametrize("readings", [1, 3, 10, 100])
def test_noise_of_the_size_of_the_tolerances_misfits_once_in_a_thousand(readings: int) -> None:
    errors = np.random.default_rng(3).standard_normal((100_000, readings))
    costs = np.sqrt((errors * errors).mean(axis=1))
    share = np.mean(
        [misfits(document(readings, cost)) for cost in costs[:: max(readings // 10, 1)]]
    )
    assert 3e-4 < share < 2e-3


def test_one_number_that_is_far_off_does_not_fit() -> None:
    assert misfits(document(1, 7.39))
    assert not misfits(document(1, 3.0))


@pytest.mark.parametrize(
    ("spacing", "best", "end"),
    [
        ("linear", 1.0, "minimum"),
        ("linear", 1.009, "minimum"),
        ("linear", 1.5, ""),
        ("linear", 9.999, "maximum"),
        ("log", 1.001, "minimum"),
        ("log", 1.009, ""),
        ("log", 10.0, "maximum"),
    ],
)
def test_a_best_value_may_be_at_the_end_of_its_range(spacing: str, best: float, end: str) -> None:
    free = {"minimum": 1.0, "maximum": 10.0, "spacing": spacing}
    assert (
        best_at({"calibration": {"parameters": {"mass": free}}}, {"name": "mass", "best": best})
        == end
    )


def test_what_was_found_says_whether_nothing_fits() -> None:
    for cost, expected in ((7.39, True), (3.0, False)):
        found = document(1, cost)
        assert with_misfits(found) == found | {"misfits": expected}
