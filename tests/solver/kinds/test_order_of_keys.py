"""Keys whose order has a meaning make another job; where it has none, it decides nothing."""

import itertools
from typing import Any

import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.scene.least_common_period import period_of

SPREADS = {
    "clearance": {"distribution": "uniform", "low": 1e-4, "high": 5e-4},
    "speed": {"distribution": "uniform", "low": 100.0, "high": 300.0},
}


def crank(**changes: Any) -> dict[str, Any]:
    return {"scene": {"preset": "slider-crank"}, "periods": 1, **changes}


def in_both_orders(table: dict[str, Any]) -> list[dict[str, Any]]:
    return [table, dict(reversed(table.items()))]


def test_the_first_axis_of_a_grid_varies_slowest_so_another_first_one_is_another_job() -> None:
    grid = {"clearance": [1e-4, 2e-4], "friction": [0.0, 0.1]}
    first, second = (admit(crank(kind="sweep", grid=one)) for one in in_both_orders(grid))
    assert first.values.tolist() != second.values.tolist()
    assert first.digest != second.digest


def test_parameters_of_a_sensitivity_have_columns_of_their_own() -> None:
    job = crank(kind="sensitivity", samples=4, channels=["acceleration"])
    first, second = (admit(job | {"parameters": one}) for one in in_both_orders(SPREADS))
    assert first.values.tolist() != second.values.tolist()
    assert first.digest != second.digest


def test_values_of_a_preset_are_a_job_in_any_order() -> None:
    values = {"clearance": 1e-4, "friction": 0.02}
    first, second = (
        admit(
            {
                "kind": "simulate",
                "scene": {"preset": "slider-crank", "parameters": one},
                "duration": 0.1,
            }
        )
        for one in in_both_orders(values)
    )
    assert first.digest == second.digest


@pytest.mark.parametrize("speeds", [(1.0, 600.0, 1.0 / 600.0), (40.0, 1.0, 1600.0), (3.0, 2.0)])
def test_a_common_period_is_that_of_the_drivers_in_any_order(speeds: tuple[float, ...]) -> None:
    found = [period_of(order).seconds for order in itertools.permutations(speeds)]
    assert found[0] is not None
    assert found == pytest.approx([found[0]] * len(found), rel=1e-15)


def test_drivers_without_a_common_period_are_named() -> None:
    told = period_of([1.0, 2.0, 2.0**0.5]).note
    assert "speeds 1 and 1.41421 rad/s have no common period" in told
