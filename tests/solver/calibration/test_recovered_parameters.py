"""Parameters found again from what they gave, and the spread that the targets leave."""

import json

import numpy as np
import pytest

from jointplay.command_line.calibration_table import calibration_lines
from jointplay.records.failure import InvalidInput
from jointplay.solver.calibration.calibrate import NothingFits, calibrate, costs_of
from jointplay.solver.calibration.fitted_scene import fitted_scene
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.kinds import admit, admit_calibration
from jointplay.solver.kinds.reported_cases import reported_cases
from jointplay.solver.scene import presets
from tests.solver.calibration.calibrations import bounce, computed, coordinates
from tests.solver.completed_runs import run

GRAVITY, CLEARANCE, MASS, STIFFNESS = 9.81, 1e-3, 1.0, 5e9


def elastic_peak(stiffness: float) -> float:
    """Peak force of an elastic impact from the bearing's centre, N, by conservation of energy.

    At the deepest penetration d: m g (c + d) = K d^2.5 / 2.5.
    """
    depth = 0.0
    for _ in range(60):
        depth = (2.5 * MASS * GRAVITY * (CLEARANCE + depth) / stiffness) ** 0.4
    return stiffness * depth**1.5


ELASTIC = bounce(
    scene={"preset": "bouncing-journal", "parameters": {"friction": 0.0, "restitution": 1.0}},
    parameters={"stiffness": {"minimum": 1e8, "maximum": 1e11, "spacing": "log"}},
    cases=[
        {
            "targets": [
                {
                    "channel": "bearing.normal_force",
                    "to": 0.018,
                    "value": elastic_peak(STIFFNESS),
                    "relative_tolerance": 0.01,
                },
                {"channel": "height", "from": 0.016, "to": 0.03, "value": 0.0, "weight": 0.0,
                 "absolute_tolerance": 1e-5},
            ]
        }
    ],
    tolerance=1e-9,
)  # fmt: skip


@pytest.fixture(scope="module")
def elastic() -> Outcome:
    return computed(ELASTIC)


def test_a_stiffness_is_recovered_from_the_peak_that_conservation_of_energy_gives(elastic):
    # force grows as K^0.4; the search stops within 1e-3 tolerances of 1 %, four digits are kept
    assert elastic.best[0] == pytest.approx(STIFFNESS, rel=1e-3)
    assert elastic.cost < 0.05


def test_its_spread_is_what_the_tolerance_leaves(elastic):
    """One per cent of the force is 2.5 % of the stiffness, to either side."""
    row = elastic.document()["parameters"][0]
    assert row["lowest"] == pytest.approx(STIFFNESS * 0.99**2.5, rel=2e-3)
    assert row["highest"] == pytest.approx(STIFFNESS * 1.01**2.5, rel=2e-3)
    # even in log K over +-1 tolerance: 5 % lies at nine tenths of the way out
    assert row["quantiles"]["0.05"] == pytest.approx(STIFFNESS * 0.991**2.5, rel=5e-3)
    assert row["open_ends"] == []


def test_what_is_not_fitted_is_shown_all_the_same(elastic):
    """Elastic, the disc comes back to where it started: the bearing's centre."""
    shown = elastic.document()["targets"][1]
    assert shown["weight"] == 0.0
    assert abs(shown["fitted"]) < 1e-7  # m: some hundred steps at 1e-9 of the bearing's size


def test_what_was_found_is_plain_json_and_repeats_itself(elastic):
    document = elastic.document()
    text = json.dumps(document, allow_nan=False)
    again = computed(json.loads(text)["calibration"])
    assert json.dumps(again.document(), allow_nan=False) == text


@pytest.mark.long
def test_the_number_of_processes_changes_nothing(elastic):
    shared = computed(ELASTIC, processes=2)
    assert shared.document() == elastic.document()


def test_stiffness_and_restitution_are_recovered_from_force_and_rebound():
    parameters = {"stiffness": 2e9, "restitution": 0.8, "friction": 0.0}
    peaks = run("bouncing-journal", 0.03, parameters=parameters, tolerance=1e-6).peaks
    force = {"channel": "bearing.normal_force", "to": 0.03}
    targets = [
        {**force, "value": peaks["bearing.normal_force"].maximum},
        {**force, "statistic": "maximum_time", "absolute_tolerance": 1e-5,
         "value": peaks["bearing.normal_force"].maximum_time},
        {"channel": "velocity", "statistic": "range", "to": 0.03, "relative_tolerance": 0.01,
         "value": peaks["velocity"].maximum - peaks["velocity"].minimum},
    ]  # fmt: skip
    found = computed(bounce(cases=[{"targets": targets}]))
    truth = np.array([2e9, 0.8])
    np.testing.assert_allclose(found.best, truth, rtol=0.02)  # 1 % of the velocity's range
    inside = coordinates(found.calibration.space, truth[None, :])[0]
    assert (found.good.members.min(axis=0) < inside).all()
    assert (inside < found.good.members.max(axis=0)).all()
    assert (found.roughness < 0.1).all()  # one impact is smooth


@pytest.mark.long
def test_two_parameters_that_one_number_cannot_tell_apart_are_reported_so():
    """One force does not fix stiffness and mass: the same force from stiffer, lighter parts."""
    free = {"stiffness": (1e8, 1e11), "mass": (0.1, 10.0)}
    document = bounce(
        scene=ELASTIC["scene"],
        parameters={
            name: {"minimum": low, "maximum": high, "spacing": "log"}
            for name, (low, high) in free.items()
        },
        spread={"generations": 60},
    )
    found = computed(document)
    # F ~ K^0.4 m^0.6: what fits lies on a line of that slope, up to the heaviest and the stiffest
    assert found.correlation()[0, 1] < -0.95
    row = found.document()["parameters"][0]
    assert row["highest"] / row["lowest"] > 100.0
    assert [found.open_ends(k) for k in range(2)] == [["maximum"], ["maximum"]]


def test_the_fitted_scene_has_the_defaults_that_give_the_fitted_values(elastic):
    document = fitted_scene(elastic, "fitted-journal")
    declared = document["parameters"]
    assert declared["stiffness"]["default"] == elastic.best[0]
    assert declared["stiffness"]["inferred"] is True
    assert "90 %" in declared["stiffness"]["help"]
    assert (declared["restitution"]["default"], declared["friction"]["default"]) == (1.0, 0.0)
    assert "Inferred: stiffness" in document["description"]
    assert document["name"] == "fitted-journal"
    job = {"kind": "simulate", "scene": document, "duration": 0.018}
    assert (
        admit(job).scene_document()["joints"]["bearing"]["clearance"]["contact"]["stiffness"]
        == elastic.best[0]
    )
    repeated = run(
        "bouncing-journal",
        0.018,
        parameters={"stiffness": elastic.best[0], "restitution": 1.0, "friction": 0.0},
        tolerance=1e-9,
    )
    found = repeated.peaks["bearing.normal_force"].maximum
    assert found == pytest.approx(elastic.values[0], rel=1e-9)  # one impact, rounding magnified


def test_a_name_that_no_scene_may_have_is_refused(elastic):
    with pytest.raises(InvalidInput, match="begin with a letter"):
        fitted_scene(elastic, "7-bars")


def test_nothing_is_said_to_fit_where_every_run_fails():
    calibration = admit_calibration(ELASTIC)

    def failing(candidates: np.ndarray) -> np.ndarray:
        return np.full((len(candidates), 2), np.nan)

    with pytest.raises(NothingFits, match="every run failed"):
        calibrate(calibration, costs_of(calibration, failing), failing, lambda done, note: None)


def test_the_numbers_that_a_source_reports_become_cases_but_for_the_ideal_ones():
    scene = presets.document("seven-bar-press")
    cases = reported_cases(scene)
    assert [case["parameters"]["clearance"] for case in cases] == [1e-4, 3e-4, 5e-4]
    expected = [entry for entry in scene["reported"] if entry["parameters"]["clearance"] > 0.0]
    assert sum(len(case["targets"]) for case in cases) == len(expected)
    document = bounce(scene={"preset": "seven-bar-press"}, cases=cases)
    assert admit_calibration(document).cases[0].duration == 2.0


def test_what_lies_beyond_a_range_is_said_to():
    """The true stiffness is five times the largest; it was said to lie in the range."""
    free = {"stiffness": {"minimum": 1e8, "maximum": 1e9, "spacing": "log"}}
    short = {"generations": 20}
    found = computed(ELASTIC | {"parameters": free, "spread": short}).document()
    (row,) = found["parameters"]
    assert row["lowest"] <= row["best"] <= row["highest"]
    shown = found["targets"][0]
    assert shown["lowest"] <= shown["fitted"] <= shown["highest"]
    told = "\n".join(calibration_lines(found))
    assert "best at its maximum: better ones may lie beyond" in told
    assert "nothing fits" in told
    assert "the true value" not in told
