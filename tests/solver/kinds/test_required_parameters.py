"""A parameter that a scene requires: it must be given, and the error says what is missing."""

from typing import Any

import pytest

import jointplay
from jointplay.client import Refused
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.presets_given import REQUIRED, given

NAME = "seven-bar-test-bed"
DISTANCE = "/scene/parameters/pivot_distance"


def test_each_one_that_is_missing_is_named_with_unit_and_range() -> None:
    found = problems({"preset": NAME, "parameters": {"speed_crank1": 6.0}})
    assert found.keys() == {
        f"/scene/parameters/{name}" for name in REQUIRED[NAME] if name != "speed_crank1"
    }
    assert "has no default and must be given" in found[DISTANCE]
    assert "between 0.298 and 0.338 m" in found[DISTANCE]


def test_none_is_not_a_value_and_one_out_of_range_is_refused() -> None:
    scene = given(NAME)
    for value, words in ((None, "must be given"), (0.4, "between 0.298 and 0.338 m")):
        scene["parameters"]["pivot_distance"] = value
        assert words in problems(scene)[DISTANCE]


def test_in_a_document_of_ones_own_its_default_is_the_value() -> None:
    scene = presets.document(NAME)
    assert DISTANCE in problems(scene)
    for name, value in REQUIRED[NAME].items():
        scene["parameters"][name]["default"] = value
    assert admit({"kind": "simulate", "scene": scene, "duration": 0.1}).joints == ("A", "B")


def test_a_study_may_vary_it_instead() -> None:
    scene = given(NAME)
    del scene["parameters"]["pivot_distance"]
    sweep = {
        "kind": "sweep",
        "scene": scene,
        "grid": {"pivot_distance": [0.31, 0.32]},
        "periods": 1,
    }
    found = admit(sweep)
    distances = [found.point_scene(k).bodies["bed"].points["O4"][0] for k in range(2)]
    assert distances == [0.31, 0.32]
    assert admit(found.job).digest == found.digest


def test_python_says_it_too() -> None:
    with pytest.raises(Refused, match="'phase' has no default and must be given"):
        jointplay.run(NAME, duration=0.1)


def problems(scene: dict[str, Any]) -> dict[str, str]:
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 0.1})
    return {problem.pointer: problem.detail for problem in refused.value.problems}
