"""Numbers that vary are checked at each of their values, as jobs of one point are."""

import copy
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets

TWO: dict[str, Any] = {
    "name": "two",
    "ground": {"points": {"a": [0.0, 0.0], "b": [1.0, 0.0]}},
    "bodies": {
        name: {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0], "e": [0.1, 0.0]}}
        for name in ("A", "B")
    },
    "joints": {
        "ja": {"type": "revolute", "bearing": "ground.a", "journal": "A.O"},
        "jb": {"type": "revolute", "bearing": "ground.b", "journal": "B.O"},
    },
    "drivers": {"motor": {"joint": "ja", "speed": 10.0}},
    "forces": {
        "f": {
            "type": "torque", "first": "ground.b", "second": "B.O", "moment": 1.0,
            "over": {"quantity": "driver", "driver": "motor"},
            "course": {"type": "sinusoidal", "amplitude": 1.0, "frequency": 1.0},
        }
    },
}  # fmt: skip


def varied(scene: dict[str, Any], path: str, values: list[float], **job: Any) -> dict[str, Any]:
    """Return a sweep of a scene over the number at a path."""
    scene = copy.deepcopy(scene)
    scene["parameters"] = {"p": {"help": "it varies", "targets": [{"path": path}]}}
    points = [{"p": value} for value in values]
    return {"kind": "sweep", "scene": scene, "points": points, "duration": 1.0, **job}


def problems(job: dict[str, Any]) -> dict[str, str]:
    with pytest.raises(InvalidInput) as caught:
        admit(job)
    return {problem.pointer: problem.detail for problem in caught.value.problems}


def test_a_course_over_the_angle_of_a_driver_repeats_every_turn_at_every_point() -> None:
    frequency = "/forces/f/course/frequency"
    admit(varied(TWO, frequency, [1.0, 2.0, 3.0]))
    told = problems(varied(TWO, frequency, [1.0, 1.5, 2.0, 2.5]))
    assert set(told) == {"/points/1/p", "/points/3/p"}
    assert all("repeats every turn" in detail for detail in told.values())


def test_a_table_that_refuses_is_asked_at_the_ends_of_what_varies() -> None:
    scene = copy.deepcopy(TWO)
    scene["forces"]["f"]["over"] = {"quantity": "time"}
    scene["forces"]["f"]["course"] = {
        "type": "table", "knots": [0.0, 1.0], "values": [0.0, 1.0], "outside": "refused",
    }  # fmt: skip
    knot = "/forces/f/course/knots/1"
    admit(varied(scene, knot, [1.0, 1.5, 2.0]))
    assert "others are refused" in str(problems(varied(scene, knot, [1.5, 0.5, 2.0])))


@pytest.mark.parametrize("values", [[2.07e11, 1e11, 5e10], [1e11, 5e10, 4e10]])
def test_a_modulus_beside_a_given_stiffness_is_idle_whatever_its_values(values) -> None:
    scene = presets.document("slider-crank")
    scene.update(parameters={}, reported=[], outputs=[])
    scene["joints"]["P"]["clearance"]["contact"] = {
        "law": "lankarani-nikravesh", "stiffness": 1e10, "restitution": 0.9,
    }  # fmt: skip
    modulus = "/joints/P/clearance/contact/youngs_modulus"
    (detail,) = problems(varied(scene, modulus, values)).values()
    assert "has no effect beside a given 'stiffness'" in detail


def test_a_pointer_has_one_spelling() -> None:
    job = varied(TWO, "/gravity/01", [-9.0, -10.0])
    assert list(problems(job)) == ["/scene/parameters/p/targets/0/path"]
    admit(varied(TWO, "/gravity/1", [-9.0, -10.0]))


def test_channels_that_only_some_points_have_are_no_default() -> None:
    scene = copy.deepcopy(TWO)
    scene["joints"]["jb"]["clearance"] = {
        "radial_clearance": 1e-4,
        "bearing_radius": 0.01,
        "contact": {"law": "lankarani-nikravesh", "restitution": 0.8},
    }
    play = "/joints/jb/clearance/radial_clearance"
    loaded = [channel.name for channel in admit(varied(scene, play, [1e-4, 2e-4])).channels]
    assert "jb.normal_force" in loaded
    names = [channel.name for channel in admit(varied(scene, play, [0.0, 1e-4])).channels]
    assert "B.theta" in names


def test_a_number_beyond_all_floats_is_refused() -> None:
    job = {"kind": "simulate", "duration": 0.1}
    scene = {"preset": "slider-crank", "parameters": {"clearance": 10**400}}
    assert "must be a number" in problems(job | {"scene": scene})["/scene/parameters/clearance"]


def test_a_section_at_the_end_is_taken_though_its_time_is_rounded() -> None:
    """2.1 rad at 0.3 rad/s are 7.000000000000001 s in floats."""
    scene = copy.deepcopy(TWO)
    scene["drivers"]["motor"]["speed"] = 0.3
    job = {"kind": "simulate", "scene": scene, "section": {"crank_angle": 2.1}}
    assert admit(job | {"duration": 7.0}).sections == 1
    assert admit(job | {"duration": 6.999}).sections == 0
