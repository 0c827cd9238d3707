"""Jobs that are refused: each with the field that is wrong and what would be right."""

import math
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.records.strict_json import parse
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.kinds.refusals import Refused, assert_refused, at, both, changed, without

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {}},
    "duration": 2.0,
}
P = "/scene/parameters"
BAD_JOBS: dict[str, Refused] = {
    "unknown kind": (at("/kind", "optimise"), "/kind", "simulate"),
    "no kind": (without("/kind"), "/kind", "required"),
    "no scene": (without("/scene"), "/scene", "required"),
    "no duration": (without("/duration"), "/duration", "required"),
    "unknown field": (at("/durations", 1.0), "/durations", "did you mean 'duration'"),
    "parameter beside the scene": (at("/clearance", 1e-4), "/clearance", f"as {P}/clearance."),
    "parameters beside the scene": (at("/parameters", {}), "/parameters", f"as {P}."),
    "parameter of a whole scene beside it": (
        both(at("/scene", presets.document("pendulum")), at("/mass", 2.0)),
        "/mass",
        f"as {P}/mass/default.",
    ),
    "scene without anything": (at("/scene", {}), "/scene", "or an object with a 'preset'"),
    "scene of a name": (at("/scene", {"name": "x"}), "/scene/bodies", "'bodies' is required"),
    "unknown preset": (at("/scene/preset", "seven-bar"), "/scene/preset", "seven-bar-press"),
    "unknown parameter": (at(f"{P}/clearence", 1e-4), f"{P}/clearence", "clearance"),
    "parameter of the wrong type": (at(f"{P}/clearance", "big"), f"{P}/clearance", "number"),
    "parameter true": (at(f"{P}/clearance", True), f"{P}/clearance", ""),
    "negative clearance": (at(f"{P}/clearance", -1e-4), f"{P}/clearance", "between 0"),
    "clearance of the bearing": (at(f"{P}/clearance", 5e-3), f"{P}/clearance", "smaller"),
    "clearance above the bearing": (at(f"{P}/clearance", 6e-3), f"{P}/clearance", "smaller"),
    "parameter not a number": (at(f"{P}/friction", math.nan), f"{P}/friction", ""),
    "parameter infinite": (at(f"{P}/friction", math.inf), f"{P}/friction", ""),
    "bad choice": (at(f"{P}/slip_velocity", "wet"), f"{P}/slip_velocity", "as-published"),
    "static above dynamic": (at(f"{P}/static_velocity", 0.1), f"{P}/static_velocity", "equal"),
    "exponent without stiffness": (at(f"{P}/exponent", 1.2), f"{P}/exponent", "stiffness"),
    "duration not a number": (at("/duration", math.nan), "/duration", "finite"),
    "duration infinite": (at("/duration", math.inf), "/duration", "finite"),
    "duration zero": (at("/duration", 0.0), "/duration", "at least"),
    "duration negative": (at("/duration", -1.0), "/duration", "at least"),
    "more digits than a whole number may have": (
        at("/steps_limit", parse(b"9223372036854775807")),  # it said to write ...808
        "/steps_limit",
        "a whole number of B, of at most 18 digits.",
    ),
    "duration a word": (at("/duration", "2"), "/duration", "number"),
    "duration true": (at("/duration", True), "/duration", "number"),
    "step zero": (at("/output_step", 0.0), "/output_step", "at least"),
    "tolerance zero": (at("/tolerance", 0.0), "/tolerance", "at least"),
    "tolerance coarse": (at("/tolerance", 0.1), "/tolerance", "at most"),
    "unknown accuracy": (at("/accuracy", "superb"), "/accuracy", "standard"),
    "tolerance and accuracy": (
        both(at("/tolerance", 1e-6), at("/accuracy", "standard")),
        "/accuracy",
        "not both",
    ),
    "method and accuracy": (
        both(at("/method", "tsitouras"), at("/accuracy", "fine")),
        "/accuracy",
        "a method or a named accuracy",
    ),
    "unknown method": (at("/method", "euler"), "/method", "rk4"),
    "tolerance dishonest": (
        both(at("/tolerance", 1e-4), at("/method", "tsitouras")),
        "/tolerance",
        "'bogacki-shampine' or 'dormand-prince-853'",
    ),
    "tolerance dishonest for all": (at("/tolerance", 5e-3), "/tolerance", "0.001 at most"),
    "fixed without a step": (at("/method", "rk4"), "/step", "needs its fixed 'step'"),
    "fixed with a tolerance": (
        both(at("/method", "rk4"), at("/step", 1e-4), at("/tolerance", 1e-6)),
        "/tolerance",
        "does not control its error",
    ),
    "step of a method without": (at("/step", 1e-4), "/step", "'rk4'"),
    "unknown channel": (at("/channels", ["slider7.vX"]), "/channels/0", "did you mean 'slider7.v"),
    "no channel": (at("/channels", []), "/channels", "at least 1"),
    "unknown formulation": (at("/formulation", "hamilton"), "/formulation", "lagrange"),
    "section angle": (at("/section", {"crank_angle": 7.0}), "/section/crank_angle", "less than"),
    "section angle without a period": (
        both(at("/scene/preset", "pendulum"), at("/section", {"crank_angle": 1.0})),
        "/section/crank_angle",
        "No driver turns, so there is no period. Sections need one",
    ),
    "a material beside a stiffness": (
        at(P, {"youngs_modulus": 7e10, "stiffness": 1e10}),
        f"{P}/youngs_modulus",
        "has no effect beside a given 'stiffness'",
    ),
    "long label": (at("/label", "x" * 201), "/label", "200"),
}


@pytest.mark.parametrize("case", BAD_JOBS)
def test_a_bad_job_is_refused_at_its_field(case: str) -> None:
    change, pointer, words = BAD_JOBS[case]
    assert_refused(changed(JOB, change), pointer, words)


@pytest.mark.parametrize("document", [None, [], "job", 3.0, {}, {"scene": []}, {"scene": None}])
def test_what_is_no_job_is_refused(document: object) -> None:
    with pytest.raises(InvalidInput):
        admit(document)


def test_every_problem_is_reported_at_once() -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({**JOB, "duration": -1.0, "tolerance": 2.0, "extra": 1})
    assert {p.pointer for p in refused.value.problems} == {"/duration", "/tolerance", "/extra"}


@pytest.mark.parametrize(
    ("preset", "pointer"),
    [("seven-bar-pres", "/scene/preset"), ("seven-bar-press", f"{P}/clearence")],
)
def test_what_is_wrong_with_a_preset_is_reported_beside_other_fields(preset, pointer) -> None:
    scene = {"preset": preset, "parameters": {"clearence": 1e-4}}
    with pytest.raises(InvalidInput) as refused:
        admit({**JOB, "duration": "2", "scene": scene})
    assert [p.pointer for p in refused.value.problems] == ["/duration", pointer]


@pytest.mark.parametrize("duration", [1e300, 1.7e308, 1e12, 1.0, 1e-12, 1e-300, 5e-324])
def test_extreme_durations_are_refused_or_admitted_but_never_crash(duration: float) -> None:
    for output_step in (None, 1e-300, 1e-16, 1e12, 1e300, 5e-324):
        job = {**JOB, "duration": duration}
        if output_step is not None:
            job["output_step"] = output_step
        try:
            found = admit(job)
        except InvalidInput:
            continue
        assert found.samples >= 2
