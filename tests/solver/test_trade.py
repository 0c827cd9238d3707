"""The work-precision study: errors against a reference, costs, and the sentence that recommends."""

from __future__ import annotations

from dataclasses import replace

import pytest

from solver.admission import admit_simulate
from solver.admission.documents import parse
from solver.integrators import METHODS
from solver.jobs import SimulateJob
from solver.trade.advice import advice, cheapest
from solver.trade.measure import KNOWN, Point, Trade, measure


@pytest.fixture(scope="module")
def trade() -> Trade:
    """The press up to a few milliseconds after its first impact."""
    job = parse({"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.015})
    assert isinstance(job, SimulateJob)
    return measure(admit_simulate(job), lambda fraction, note: None)


def series(trade: Trade, method: str) -> list[Point]:
    return [point for point in trade.points if point.method == method]


def test_every_method_is_measured_against_a_reference_that_is_known(trade: Trade) -> None:
    assert {point.method for point in trade.points} == set(METHODS)
    assert trade.uncertainty < KNOWN
    assert 0.0 < trade.window <= trade.duration


@pytest.mark.parametrize("method", [name for name, each in METHODS.items() if each.error])
def test_a_tighter_tolerance_costs_more_and_errs_less(trade: Trade, method: str) -> None:
    points = {point.tolerance: point for point in series(trade, method)}
    coarse, fine = points[1e-5], points[1e-9]
    assert coarse.error is not None
    assert fine.error is not None
    # four decades of tolerance are at least two of error, however lucky the coarse run was
    assert fine.error < 0.01 * coarse.error
    assert fine.evaluations > coarse.evaluations


def test_steps_of_a_press_over_ten_thousand_fail_at_the_first_impact(trade: Trade) -> None:
    longest = series(trade, "rk4")[0]
    assert longest.step == pytest.approx(2e-4)
    assert longest.error is None


def test_tolerances_that_jobs_may_not_ask_for_are_marked(trade: Trade) -> None:
    for point in trade.points:
        if point.tolerance is not None:
            limit = METHODS[point.method].largest_tolerance
            assert point.admitted == (point.tolerance <= limit)


def test_the_cheapest_admitted_run_is_recommended(trade: Trade) -> None:
    best = cheapest(trade.points, 1e-3)
    assert best is not None
    able = [p for p in trade.points if p.admitted and p.error is not None and p.error <= 1e-3]
    assert best.evaluations == min(point.evaluations for point in able)
    assert cheapest(trade.points, 0.0) is None
    assert advice(trade).startswith("The default, tsitouras at 1e-06, makes an error of")


def test_a_default_as_accurate_as_the_reference_leaves_nothing_to_choose(trade: Trade) -> None:
    assert "nothing to choose" in advice(replace(trade, uncertainty=1.0))
