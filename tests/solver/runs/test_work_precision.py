"""The accuracy-study: errors against a reference, costs, and the sentence that recommends."""

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import pytest

import jointplay.solver.runs.work_precision.run
import jointplay.solver.runs.work_precision.timed_run
from jointplay.command_line.accuracy import accuracy_lines
from jointplay.records.energy_residual import RELATIVE_ENERGY_RESIDUAL
from jointplay.records.point import PointEnd
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.work_precision.run import KNOWN, WorkPrecisionRun
from jointplay.solver.runs.work_precision.work_precision import (
    Point,
    WorkPrecision,
    advice,
    cheapest,
)
from jointplay.solver.scene.presets import document

PRESS = {"kind": "accuracy-study", "scene": {"preset": "seven-bar-press"}}
FEW = PRESS | {"duration": 0.003, "methods": ["tsitouras", "rk4"], "tolerances": [1e-4, 1e-8]}
"""Before any contact, where every run takes milliseconds."""


@dataclass
class Failed:
    """As a store has it."""

    code: str
    detail: str


class Collected:
    """The runs that ended, as a store would hold them."""

    def __init__(self, study: Study, ends: list[PointEnd]) -> None:
        runs = [run.document() for run in study.runs]
        self.attributes: dict[str, Any] = {"job": study.job, "runs": runs}
        self.points = study.points
        self.complete = len(ends) == study.points
        self.failures = {end.point: Failed(end.code, end.detail) for end in ends if end.code}
        names = {name for end in ends for name in end.statistics}
        self.statistics = {name: np.full(study.points, np.nan) for name in names}
        for end in ends:
            for name, value in end.statistics.items():
                self.statistics[name][end.point] = value


def admitted(job: dict[str, Any]) -> Study:
    study = admit(job)
    assert isinstance(study, Study)
    return study


def ends_of(
    run: WorkPrecisionRun, until: Callable[[PointEnd], bool] = lambda end: False
) -> list[PointEnd]:
    found = []
    for piece in run.slices():
        assert 0.0 <= piece.fraction <= 1.0
        found += piece.ended
        if piece.ended and until(piece.ended[-1]):
            break
    return found


def measured(job: dict[str, Any]) -> Collected:
    study = admitted(job)
    return Collected(study, ends_of(WorkPrecisionRun(study, 0)))


def repeatable(ends: list[PointEnd]) -> list[dict[str, Any]]:
    """The findings that do not depend on the clock."""
    return [
        asdict(end) | {"statistics": repr({**end.statistics, "seconds": 0.0}), "peaks": None}
        for end in ends
    ]


@pytest.fixture(scope="module")
def found() -> WorkPrecision:
    """The press up to a few milliseconds after its first impact."""
    return WorkPrecision.of(measured(PRESS | {"duration": 0.015}))


def series(found: WorkPrecision, method: str) -> list[Point]:
    return [point for point in found.points if point.method == method]


def test_every_method_is_measured_against_a_reference_that_is_known(
    found: WorkPrecision,
) -> None:
    assert found.complete
    assert {point.method for point in found.points} == set(METHODS)
    assert found.uncertainty is not None
    assert found.uncertainty < KNOWN
    assert found.window is not None
    assert 0.0 < found.window <= found.duration == 0.015


@pytest.mark.parametrize("method", [name for name, each in METHODS.items() if each.error])
def test_a_tighter_tolerance_costs_more_and_errs_less(found: WorkPrecision, method: str) -> None:
    points = {point.tolerance: point for point in series(found, method)}
    coarse, fine = points[1e-5], points[1e-9]
    assert coarse.error is not None
    assert fine.error is not None
    # four decades of tolerance are at least two of error, however lucky the coarse run was
    assert fine.error < 0.01 * coarse.error
    assert fine.evaluations > coarse.evaluations


def test_steps_of_a_press_over_ten_thousand_fail_at_the_first_impact(
    found: WorkPrecision,
) -> None:
    longest = series(found, "rk4")[0]
    assert longest.step == pytest.approx(2e-4)
    assert longest.error is None
    assert longest.failure is not None
    assert "smaller 'step'" in longest.failure


def test_tolerances_that_jobs_may_not_ask_for_are_marked(found: WorkPrecision) -> None:
    for point in found.points:
        if point.tolerance is not None:
            limit = METHODS[point.method].largest_tolerance
            assert point.admitted == (point.tolerance <= limit)


def test_the_cheapest_admitted_run_is_recommended(found: WorkPrecision) -> None:
    best = cheapest(found.points, 1e-3)
    assert best is not None
    able = [p for p in found.points if p.admitted and p.error is not None and p.error <= 1e-3]
    assert best.evaluations == min(point.evaluations for point in able)
    assert cheapest(found.points, 0.0) is None
    told = found.document()["advice"]
    assert told.startswith("The default, tsitouras at 1e-06, makes an error of")


def test_a_default_as_accurate_as_the_reference_leaves_nothing_to_choose(
    found: WorkPrecision,
) -> None:
    assert "nothing to choose" in advice(found.points, 1.0)


def test_nothing_is_recommended_before_all_runs_have_ended(found: WorkPrecision) -> None:
    assert replace(found, complete=False).document()["advice"] is None


def test_the_default_is_measured_whatever_is_asked_for() -> None:
    found = WorkPrecision.of(measured(FEW | {"methods": ["rk4"]}))
    assert [point.method for point in found.points] == ["rk4"] * 6 + ["tsitouras"]
    assert found.document()["advice"] is not None


@pytest.mark.parametrize("ended", [0, 1, 4])
def test_a_study_that_goes_on_keeps_what_was_measured_and_repeats_but_for_seconds(
    ended: int,
) -> None:
    study = admitted(FEW)
    undisturbed = ends_of(WorkPrecisionRun(study, 0))
    begun = WorkPrecisionRun(study, 0)
    first = ends_of(begun, lambda end: end.point == ended)
    rest = ends_of(WorkPrecisionRun(study, 0, begun.checkpoint()))
    assert [end.point for end in (*first, *rest)] == list(range(study.points))
    assert repeatable([*first, *rest]) == repeatable(undisturbed)


def give_up_after(monkeypatch: pytest.MonkeyPatch, evaluations: float) -> None:
    """Give runs up after so many evaluations, which are looked at every ten steps."""
    monkeypatch.setattr(jointplay.solver.runs.work_precision.timed_run, "BUDGET", 10)
    monkeypatch.setattr(jointplay.solver.runs.work_precision.run, "MOST_REFERENCES", 0.0)
    monkeypatch.setattr(jointplay.solver.runs.work_precision.run, "FEWEST", evaluations)


def test_a_method_that_takes_too_many_evaluations_is_given_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The grid's own evaluations double."""
    give_up_after(monkeypatch, 150.0)
    found = measured(FEW | {"methods": ["rk4"]})
    # 0.003 s in steps of 0.2 ms, 0.1 ms, 50 us: 60, 120, 240 evaluations
    codes = {point: one.code for point, one in found.failures.items()}
    assert codes == {4: "given-up", 5: "left-out", 6: "left-out", 7: "left-out"}
    points = WorkPrecision.of(found).points
    assert [point.error is None for point in points] == [False, False, True, False]
    assert points[2].evaluations > 150
    assert points[2].failure is not None
    assert points[2].failure.startswith("Given up at t =")


def test_a_reference_that_is_given_up_says_nothing_of_looser_tolerances(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    give_up_after(monkeypatch, 50.0)
    found = measured(FEW | {"methods": ["dormand-prince-853"]})
    assert found.failures[1].code == "given-up"
    assert all(failure.code != "left-out" for failure in found.failures.values())


def test_nothing_is_known_where_references_agree_at_the_start_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(jointplay.solver.runs.work_precision.run, "KNOWN", 0.0)
    found = WorkPrecision.of(measured(FEW | {"methods": ["tsitouras"]}))
    assert found.window == 0.0
    assert found.uncertainty is None
    assert [point.error for point in found.points] == [None] * 3
    assert found.document()["advice"] == advice(found.points, None)
    lines = "\n".join(accuracy_lines(found.document()))
    assert "| unknown |" in lines
    assert "no error is known: ask for a shorter duration" in lines


@pytest.mark.parametrize("direction", [-1.0, 1.0])
def test_energy_that_an_element_gives_is_none_that_was_taken(direction: float) -> None:
    scene = document("slider-crank")
    push = {"type": "force", "magnitude": 1e4, "direction": [direction, 0.0]}
    scene["forces"] = {"push": push | {"first": "ground.O", "second": "slider.pin"}}
    job = PRESS | {"scene": scene, "duration": 0.004, "methods": ["tsitouras"]}
    found = measured(job | {"tolerances": [1e-6]})
    assert np.isfinite(found.statistics[RELATIVE_ENERGY_RESIDUAL]).all()
