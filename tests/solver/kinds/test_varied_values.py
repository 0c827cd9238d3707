"""Values of a preset's parameters that a study varies: refused, as they would have no effect."""

from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit, parse

RANGE = {"from": 25.0, "to": 33.0, "count": 5}
SCENE = {"preset": "impact-oscillator", "parameters": {"speed": 20.0}}
STUDIES: dict[str, dict[str, Any]] = {
    "a diagram": {"kind": "bifurcation", "parameter": "speed", "values": RANGE},
    "a sweep": {"kind": "sweep", "grid": {"speed": [25.0, 33.0]}, "periods": 1},
    "a chart": {
        "kind": "chart",
        "along": {"parameter": "amplitude", "values": [4e-3, 6e-3]},
        "by": {"parameter": "speed", "values": RANGE},
    },
    "a branch": {"kind": "continuation", "parameter": "speed", "values": RANGE},
    "a calibration": {
        "kind": "calibration",
        "parameters": {"speed": {"minimum": 25.0, "maximum": 33.0}},
        "cases": [{"targets": [{"channel": "mass.x", "to": 0.01, "value": 0.01}]}],
    },
}


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_a_value_of_what_varies_is_refused_where_it_is_submitted_alone(study):
    with pytest.raises(InvalidInput) as refused:
        admit(study | {"scene": SCENE})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/parameters/speed"
    assert problem.detail == "The study varies 'speed'; leave this value out."
    filled = admit(study | {"scene": {"preset": "impact-oscillator"}}).job
    assert admit(filled).digest
    filled["scene"]["parameters"]["speed"] = 20.0
    assert parse(filled).digest


def test_a_second_parameter_of_a_branch_begins_at_the_value_of_the_scene():
    second = {"parameter": "amplitude", "values": {"from": 4e-3, "to": 6e-3, "count": 4}}
    scene = {"preset": "impact-oscillator", "parameters": {"amplitude": 4.5e-3}}
    admitted = admit(STUDIES["a branch"] | {"scene": scene, "second": second})
    assert admitted.second.start == 4.5e-3
