"""Studies that are refused before anything is queued: at which field, and what would be right."""

import math
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from tests.solver.kinds.refusals import assert_refused
from tests.solver.runs.study.jobs_of_studies import (
    ACCURACY_STUDY,
    BIFURCATION,
    ENSEMBLE,
    POINCARE,
)


def press(**parameters: Any) -> dict[str, Any]:
    return {"preset": "seven-bar-press", "parameters": parameters}


def values(**changes: Any) -> dict[str, Any]:
    return {"from": 1e-4, "to": 1e-3, "count": 10, **changes}


LOOSE_GUIDE = {"preset": "slider-crank", "parameters": {"clearance_guide": 1e-4}}
PENDULUM = {"preset": "pendulum"}
B, P, E, A = BIFURCATION, POINCARE, ENSEMBLE, ACCURACY_STUDY

BAD: dict[str, tuple[dict[str, Any], dict[str, Any], str, str]] = {
    "unknown kind": (B, {"kind": "bifurcaton"}, "/kind", "did you mean 'bifurcation'"),
    "kind of another type": (B, {"kind": ["sweep"]}, "/kind", "must be one of"),
    "field of another kind": (B, {"members": 3}, "/members", "There is no field"),
    "unknown parameter": (B, {"parameter": "clearence"}, "/parameter", "'clearance'"),
    "parameter that is a word": (B, {"parameter": "slip_velocity"}, "/parameter", "as-published"),
    "parameter that others override": (
        B,
        {"scene": press(clearance_A=1e-4, clearance_B=1e-4)},
        "/parameter",
        "'clearance_A', 'clearance_B' override it",
    ),
    "value below the range": (B, {"values": [1e-4, -1e-4]}, "/values/1", "Value 1 of 'clearance'"),
    "value above the range": (B, {"values": [1e-4, 1.0, 1e-4]}, "/values/1", "between 0 and 0.05"),
    "value not finite": (B, {"values": [1e-4, math.inf]}, "/values/1", "finite"),
    "value not a number": (B, {"values": [1e-4, "big"]}, "/values/1", "number"),
    "value true": (B, {"values": [1e-4, True]}, "/values/1", "number"),
    "no values": (B, {"values": []}, "/values", "at least 1"),
    "values of another form": (B, {"values": 1e-4}, "/values", "'from', 'to' and 'count'"),
    "end of a range outside": (B, {"values": values(to=1.0)}, "/values/to", "Value 9 of"),
    "start of a range outside": (
        B,
        {"values": values(**{"from": -1.0})},
        "/values/from",
        "Value 0",
    ),
    "count 0": (B, {"values": values(count=0)}, "/values/count", "at least 1"),
    "count negative": (B, {"values": values(count=-5)}, "/values/count", "at least 1"),
    "count not whole": (B, {"values": values(count=2.5)}, "/values/count", "whole number"),
    "one value from here to there": (B, {"values": values(count=1)}, "/values/count", "2 at least"),
    "a range that stands still": (B, {"values": values(to=1e-4)}, "/values/to", "the same"),
    "ratios from zero": (
        B,
        {"values": values(spacing="log", **{"from": 0.0})},
        "/values/spacing",
        "above zero",
    ),
    "unknown spacing": (B, {"values": values(spacing="cubic")}, "/values/spacing", "'log'"),
    "clearance of the bearing": (
        B,
        {"values": [1e-4, 6e-3]},
        "/values/1",
        "Value 1 (clearance = 0.006 m): A radial clearance of 0.006 m leaves no journal",
    ),
    "static above dynamic velocity": (
        B,
        {"parameter": "dynamic_velocity", "values": [1e-3, 1e-5]},
        "/values/1",
        "static limit velocity",
    ),
    "exponent without stiffness": (
        B,
        {"scene": press(), "parameter": "exponent", "values": [1.5, 1.3]},
        "/values/1",
        "stiffness",
    ),
    "clearance zero": (B, {"values": [1e-4, 0.0]}, "/values/1", "'simulate' runs the ideal"),
    "clearance zero alone": (B, {"values": [0.0]}, "/values/0", "no motion to integrate"),
    "no freedom at all": (P, {"scene": press(clearance=0.0)}, "/scene", "no motion to integrate"),
    "a fixed parameter that is wrong": (
        B,
        {"scene": press(friction=-1.0)},
        "/scene/parameters/friction",
        "between 0 and 10",
    ),
    "a scene that is wrong everywhere": (
        B,
        {"scene": press(exponent=1.2)},
        "/scene/parameters/exponent",
        "stiffness",
    ),
    "unknown preset": (P, {"scene": {"preset": "press"}}, "/scene/preset", "seven-bar-press"),
    "no period": (P, {"scene": PENDULUM}, "/section", "No driver turns"),
    "no period at one value": (
        B,
        {"parameter": "speed", "values": [1.0, 0.0]},
        "/values/1",
        "No driver turns",
    ),
    "irrational ratio of speeds": (
        P,
        {"scene": press(speed=1.0, speed_crank4=math.sqrt(2.0))},
        "/section",
        "ratio of whole numbers",
    ),
    "irrational ratio at one value": (
        B,
        {"parameter": "speed_crank4", "values": [-math.pi, 3.0]},
        "/values/1",
        "ratio of whole numbers",
    ),
    "a section of no form": (P, {"section": 3.0}, "/section", "'crank_angle'"),
    "crank angle beyond a turn": (
        P,
        {"section": {"crank_angle": 7.0}},
        "/section/crank_angle",
        "less than 6.28319 rad",
    ),
    "two sections at once": (
        P,
        {"section": {"onset": "A", "crank_angle": 0.0}},
        "/section/crank_angle",
        "does not go with the others here",
    ),
    "onset at no joint": (P, {"section": {"onset": "Q"}}, "/section/onset", "no joint 'Q'"),
    "onset at what is no name": (
        P,
        {"section": {"onset": "A B"}},
        "/section/onset",
        "a joint or a contact of one, for example A or guide.corner_1",
    ),
    "onset at an ideal joint": (
        P,
        {"section": {"onset": "C2"}},
        "/section/onset",
        "contacts begin in: A, B",
    ),
    "onset at a guide of four corners": (
        {**P, "scene": LOOSE_GUIDE},
        {"section": {"onset": "guide"}},
        "/section/onset",
        "take one of guide.corner_1, guide.corner_2, guide.corner_3, guide.corner_4",
    ),
    "crossing of no channel": (
        P,
        {"section": {"channel": "slider7.z", "value": 0.0}},
        "/section/channel",
        "did you mean 'slider7.",
    ),
    "crossing without a value": (
        P,
        {"section": {"channel": "slider7.x"}},
        "/section/value",
        "required",
    ),
    "unknown direction": (
        P,
        {"section": {"channel": "slider7.x", "value": 1.7, "direction": "left"}},
        "/section/direction",
        "'up' or 'down'",
    ),
    "settle negative": (P, {"settle": -1}, "/settle", "at least 0"),
    "settle a word": (P, {"settle": "long"}, "/settle", "'auto'"),
    "settle not whole": (P, {"settle": 10.5}, "/settle", "whole number"),
    "settle true": (P, {"settle": True}, "/settle", "whole number"),
    "record nothing": (P, {"record": 0}, "/record", "at least 1 period, not 0."),
    "unknown observable": (P, {"observables": ["slider7.X"]}, "/observables/0", "'slider7.x'"),
    "no observable": (P, {"observables": []}, "/observables", "at least 1"),
    "unknown indicator": (P, {"indicators": ["chaos"]}, "/indicators/0", "'lyapunov'"),
    "indicators a word": (P, {"indicators": "some"}, "/indicators", "'all'"),
    "unknown continuation": (B, {"continuation": "up"}, "/continuation", "'forward'"),
    "chains of nothing": (B, {"chains": 4}, "/chains", "no effect without a 'continuation'"),
    "no chains": (B, {"chains": 0}, "/chains", "at least 1"),
    "tolerance and accuracy": (
        P,
        {"tolerance": 1e-6, "accuracy": "standard"},
        "/accuracy",
        "not both",
    ),
    "exponents along steps of another method": (
        P,
        {"method": "dormand-prince-853", "indicators": ["lyapunov"]},
        "/method",
        "'tsitouras'",
    ),
    "exponents of a draft": (
        P,
        {"accuracy": "draft", "indicators": "all"},
        "/accuracy",
        "'tsitouras'",
    ),
    "a fixed step": (P, {"method": "rk4", "step": 1e-4}, "/method", "error control"),
    "no member": (E, {"members": 0}, "/members", "at least 1"),
    "no spread": (E, {"spread": 0.0}, "/spread", "all the same; it must be above 0"),
    "spread of one member": (E, {"members": 1, "spread": 0.1}, "/spread", "several 'members'"),
    "negative seed": (E, {"seed": -1}, "/seed", "at least 0"),
    "an ensemble in absolute coordinates": (
        E,
        {"formulation": "lagrange"},
        "/formulation",
        "'reduced'",
    ),
    "statistics of another kind of study": (B, {"statistics": ["mean"]}, "/statistics", "no field"),
    "one tolerance of all": (A, {"tolerance": 1e-6}, "/tolerance", "did you mean 'tolerances'"),
    "no tolerances": (A, {"tolerances": []}, "/tolerances", "at least 1"),
    "tolerance beyond the reference": (A, {"tolerances": [1e-13]}, "/tolerances/0", "at least"),
    "tolerance of no use": (A, {"tolerances": [1e-4, 0.1]}, "/tolerances/1", "at most 0.01"),
    "unknown method": (A, {"methods": ["rk45"]}, "/methods/0", "'rk4'"),
    "method of no name": (A, {"methods": ["auto"]}, "/methods/0", "'tsitouras'"),
    "no methods": (A, {"methods": []}, "/methods", "at least 1"),
    "no duration": (A, {"duration": 0.0}, "/duration", "at least 1e-09"),
    "nothing to integrate": (A, {"scene": press(clearance=0.0)}, "/scene", "positive clearance"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_study_is_refused_at_its_field(case: str) -> None:
    job, changes, pointer, words = BAD[case]
    assert_refused({**job, **changes}, pointer, words)


def test_many_bad_values_are_counted_and_a_few_are_named() -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({**B, "values": [1e-4] + [-1.0 - k for k in range(100)]})
    assert [p.pointer for p in refused.value.problems] == [
        f"/values/{k}" for k in [*range(1, 8), 100]
    ]
    assert refused.value.problems[-1].detail.endswith("So it is with 92 others.")


def test_all_that_a_document_gets_wrong_is_reported_at_once() -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({**B, "settle": -1, "record": 0, "values": [1e-4, "x"], "extra": 1})
    found = {problem.pointer for problem in refused.value.problems}
    assert found == {"/settle", "/record", "/values/1", "/extra"}
