"""Sensitivities: what is refused, and how their points are planned."""

import json

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.records.strict_json import MalformedJson
from jointplay.records.strict_json import parse as parse_json
from jointplay.solver.kinds import admit, parse

UNIFORM = {"distribution": "uniform", "low": 1e-4, "high": 5e-4}
NORMAL = {"distribution": "normal", "mean": 1e-4, "standard_deviation": 1e-4}
JOB = {
    "kind": "sensitivity",
    "scene": {"preset": "seven-bar-press"},
    "parameters": {"clearance_A": UNIFORM, "clearance_B": UNIFORM | {"high": 3e-4}},
    "samples": 8,
    "periods": 1,
}


def drawn(**changes):
    """Return parameters of which one is changed."""
    return {"parameters": JOB["parameters"] | {"clearance_A": UNIFORM | changes}}


def refusal(changes, error=InvalidInput):
    with pytest.raises(error) as refused:
        admit(JOB | changes)
    (problem,) = refused.value.problems
    return problem.pointer, problem.detail


@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"parameters": {}}, "/parameters", "at least 1"),
        ({"parameters": {"slack": UNIFORM}}, "/parameters/slack", "no parameter 'slack'"),
        ({"parameters": {"slip_velocity": UNIFORM}}, "/parameters/slip_velocity", "are numbers"),
        ({"parameters": {"clearance": {"low": 0.0}}}, "/parameters/clearance/distribution", "'un"),
        (drawn(distribution="beta"), "/parameters/clearance_A/distribution", "'triangular'"),
        (drawn(high=1e-4), "/parameters/clearance_A/high", "not above 'low'"),
        (drawn(high=0.06), "/parameters/clearance_A/high", "between 0 and 0.05 m"),
        (drawn(low=-1e-4), "/parameters/clearance_A/low", "between 0 and 0.05 m"),
        (
            drawn(distribution="triangular", mode=1.0),
            "/parameters/clearance_A/mode",
            "lies between 'low'",
        ),
        (drawn(distribution="log-uniform", low=0.0), "/parameters/clearance_A/low", "above zero"),
        (
            drawn(distribution="truncated-normal", mean=0.04, standard_deviation=1e-4),
            "/parameters/clearance_A/high",
            "standard deviations beyond",
        ),
        ({"parameters": {"clearance": NORMAL}}, "/parameters/clearance", "truncated-normal"),
        (
            drawn(distribution="truncated-normal", mean=2e-4, standard_deviation=0.0),
            "/parameters/clearance_A/standard_deviation",
            "above zero",
        ),
        ({"samples": 12}, "/samples", "such as 8 or 16"),
        ({"samples": 2}, "/samples", "at least 4"),
        ({"design": "sobol"}, "/design", "'saltelli'"),
        ({"statistics": ["avarage"]}, "/statistics/0", "'median'"),
        ({"channels": ["C.normal_force"]}, "/channels", "did you mean"),
        ({"periods": None}, "/duration", "'periods'"),
    ],
)
def test_a_sensitivity_that_cannot_be_is_refused_at_its_field(changes, pointer, words):
    found, sentence = refusal(changes)
    assert found.startswith(pointer)
    assert words in sentence


def test_a_parameter_that_two_others_stand_for_changes_nothing():
    both = JOB["parameters"] | {"clearance": UNIFORM}
    assert refusal({"parameters": both})[0] == "/parameters/clearance"


def test_a_parameter_is_given_once():
    text = json.dumps(JOB).replace('"clearance_B"', '"clearance_A"')
    with pytest.raises(MalformedJson, match="clearance_A"):
        parse_json(text.encode())


@pytest.mark.parametrize(
    ("changes", "fit"),
    [
        ({"samples": 2**20}, "16384 rows fit"),
        ({"samples": 10**6, "design": "morris"}, "33333 rows fit"),
        ({"samples": 10**12, "design": "latin-hypercube"}, "100000 rows fit"),
    ],
)
def test_of_too_many_points_it_is_told_how_many_fit(changes, fit):
    pointer, sentence = refusal(changes, LimitExceeded)
    assert pointer == "/samples"
    assert fit in sentence


@pytest.mark.parametrize(("design", "points"), [("saltelli", 32), ("morris", 24)])
def test_a_planned_sensitivity_is_the_one_that_was_admitted(design, points):
    admitted = admit(JOB | {"design": design, "statistics": ["mean"]})
    assert admitted.points == points
    planned = parse(json.loads(json.dumps(admitted.job)))
    assert planned.digest == admitted.digest
    assert planned.values.tobytes() == admitted.values.tobytes()
    assert planned.blocks == admitted.blocks
    assert admitted.job["seed"] == 0
    other = admit(JOB | {"design": design, "seed": 1})
    assert other.digest != admitted.digest
    assert not np.array_equal(other.values, admitted.values)


def test_values_lie_where_the_distributions_put_them():
    values = admit(JOB | {"samples": 128, "design": "latin-hypercube"}).values
    assert values.shape == (128, 2)
    assert values.mean(axis=0) == pytest.approx([3e-4, 2e-4], rel=1e-2)
    assert values.min(axis=0) == pytest.approx([1e-4, 1e-4], rel=0.05)
    assert values.max(axis=0) == pytest.approx([5e-4, 3e-4], rel=0.05)
