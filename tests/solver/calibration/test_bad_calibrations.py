"""Calibrations that are refused before anything is computed: where, and what would be right."""

from typing import Any

import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit_calibration
from jointplay.solver.scene import presets
from jointplay.worker.local.measures import measures
from tests.solver.calibration.calibrations import bounce

FORCE = {"channel": "bearing.normal_force", "to": 0.018, "value": 1000.0}


def target(**changes: Any) -> dict[str, Any]:
    changed = {**FORCE, **changes}
    kept = {name: value for name, value in changed.items() if value is not None}
    return {"cases": [{"targets": [kept]}]}


def case(**parameters: Any) -> dict[str, Any]:
    return {"cases": [{"parameters": parameters, "targets": [FORCE]}]}


def free(name: str = "stiffness", **changes: Any) -> dict[str, Any]:
    bounds = {"minimum": 1e8, "maximum": 1e10, **changes}
    return {"parameters": {name: bounds}}


T, C = "/cases/0/targets/0", "/cases/0/parameters"
BAD: dict[str, tuple[dict[str, Any], str, str]] = {
    "another kind": ({"kind": "sweep"}, "/kind", "must be 'calibration'"),
    "unknown field": ({"target": []}, "/target", "There is no field 'target'"),
    "unknown preset": ({"scene": {"preset": "press"}}, "/scene/preset", "seven-bar-press"),
    "no parameters": ({"parameters": {}}, "/parameters", "at least 1"),
    "no cases": ({"cases": []}, "/cases", "at least 1"),
    "unknown parameter": (free("stifness"), "/parameters/stifness", "'stiffness'"),
    "bounds swapped": (free(minimum=1e11), "/parameters/stiffness/minimum", "is not below"),
    "bound outside": (free(minimum=0.5), "/parameters/stiffness/minimum", "between 1 and 1e+18"),
    "ratios from zero": (
        free("restitution", minimum=0.0, maximum=1.0, spacing="log"),
        "/parameters/restitution/spacing",
        "above zero",
    ),
    "unknown parameter of a case": (case(clearence=1e-3), f"{C}/clearence", "'clearance'"),
    "value of a case outside": (case(clearance=1.0), f"{C}/clearance", "between"),
    "value of a case out of place": (case(mass="heavy"), f"{C}/mass", "is a number"),
    "parameter both free and set": (case(stiffness=1e9), f"{C}/stiffness", "is to be found"),
    "unknown channel": (target(channel="bearing.force"), f"{T}/channel", "'bearing.force_"),
    "no value": (target(value=None), f"{T}/value", "one of 'value' and 'between'"),
    "two values": (target(between=[1.0, 2.0]), f"{T}/value", "not both"),
    "limits swapped": (target(value=None, between=[2.0, 1.0]), f"{T}/between", "in that order"),
    "no limit": (target(value=None, between=[None, None]), f"{T}/between", "may be null"),
    "two tolerances": (
        target(relative_tolerance=0.1, absolute_tolerance=1.0),
        f"{T}/absolute_tolerance",
        "not both",
    ),
    "a share of zero": (target(value=0.0), f"{T}/absolute_tolerance", "share of zero"),
    "window backwards": (target(**{"from": 0.02}), f"{T}/to", "before it begins"),
    "grid too coarse": (target(sampled=1.0, **{"from": 0.01}), f"{T}/sampled", "no multiple"),
    "grid too fine": (target(sampled=1e-9), f"{T}/sampled", "at most 100000"),
    "grid finer than numbers": (target(sampled=5e-324), f"{T}/sampled", "at most 100000"),
    "grid of a late window": (
        target(sampled=1e-6, **{"from": 1000.0, "to": 1000.01}), f"{T}/sampled", "earlier window"
    ),
    "unknown statistic": (target(statistic="mean"), f"{T}/statistic", "'maximum'"),
    "nothing to fit": (target(weight=0.0), f"{T}/weight", "No target has a weight"),
    "ideal mechanism": (
        {"scene": {"preset": "slider-crank"}, "cases": [{"parameters": {"clearance": 0.0},
         "targets": [{"channel": "acceleration", "to": 0.01, "value": 1.0}]}],
         "parameters": {"restitution": {"minimum": 0.5, "maximum": 1.0}}},
        "/scene",
        "No joint has clearance",
    ),
    "parameters that do not go together": (
        {"scene": {"preset": "slider-crank"}, "parameters": {
            "static_velocity": {"minimum": 1e-5, "maximum": 1e-1}},
         "cases": [{"targets": [{"channel": "acceleration", "to": 0.01, "value": 1.0}]}]},
        "/parameters/static_velocity",
        "is above the dynamic one",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "pointer", "sentence"), BAD.values(), ids=BAD)
def test_what_cannot_be_calibrated_is_refused_at_its_field(changes, pointer, sentence):
    with pytest.raises(InvalidInput) as refused:
        admit_calibration(bounce(**changes))
    assert [p.pointer for p in refused.value.problems] == [pointer], refused.value
    assert sentence in refused.value.problems[0].detail
    assert refused.value.problems[0].detail.endswith((".", "?"))


def test_what_is_no_object_is_refused():
    with pytest.raises(InvalidInput, match="JSON object"):
        admit_calibration([])


def test_a_word_that_shall_move_is_refused():
    document = bounce(
        scene={"preset": "seven-bar-press"},
        parameters={"slip_velocity": {"minimum": 0.0, "maximum": 1.0}},
        cases=[{"targets": [{"channel": "acceleration", "to": 0.01, "value": 1.0}]}],
    )
    with pytest.raises(InvalidInput, match="material, as-published"):
        admit_calibration(document)


def test_two_grids_in_one_case_are_refused_at_the_second():
    cases = [{"targets": [{**FORCE, "sampled": 1e-4}, FORCE, {**FORCE, "sampled": 2e-4}]}]
    with pytest.raises(InvalidInput) as refused:
        admit_calibration(bounce(cases=cases))
    assert [p.pointer for p in refused.value.problems] == ["/cases/0/targets/2/sampled"]


def test_hours_of_computing_are_refused_with_the_estimate():
    with pytest.raises(LimitExceeded, match="runs of"):
        admit_calibration(bounce(search={"population": 1000, "generations": 10_000}))


def test_a_channel_that_drivers_prescribe_is_refused_at_the_target():
    document = bounce(
        scene={"preset": "slider-crank"},
        parameters={"restitution": {"minimum": 0.5, "maximum": 1.0}},
        cases=[
            {"targets": [{"channel": "acceleration", "to": 0.001, "value": 1e4}]},
            {"targets": [{"channel": "crank.vx", "to": 0.001, "value": 1.0}]},
        ],
    )
    with pytest.raises(InvalidInput) as refused, measures(admit_calibration(document), 1):
        pass
    assert [p.pointer for p in refused.value.problems] == ["/cases/1/targets/0/channel"]


def test_a_scene_given_whole_is_refused_in_the_same_places():
    scene = presets.document("bouncing-journal")
    for parameters, place in (({"clearance": 1.0}, "clearance"), ({"size": 1.0}, "size")):
        with pytest.raises(InvalidInput) as refused:
            admit_calibration(bounce(scene=scene, **case(**parameters)))
        assert [p.pointer for p in refused.value.problems] == [f"{C}/{place}"]


@pytest.mark.parametrize("weight", [1.0, 0.0])
def test_candidates_of_the_spread_count_where_they_run(weight: float) -> None:
    cases = [{"targets": [FORCE | {"weight": 1.0 if k == 0 else weight}]} for k in range(16)]
    asked = bounce(cases=cases, search={"population": 2, "generations": 1})
    asked["spread"] = {"generations": 10_000}  # of 64 chains: 10.24 million runs in 16 cases
    if weight:
        with pytest.raises(LimitExceeded) as refused:
            admit_calibration(asked)
        (problem,) = refused.value.problems
        assert problem.pointer == "/spread/generations"
        assert "640008 candidates, 640000 of them of the spread, in 16 cases" in problem.detail
        assert "1.02e+07 runs" in problem.detail
    else:
        assert admit_calibration(asked)
