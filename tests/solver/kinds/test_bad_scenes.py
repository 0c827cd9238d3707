"""Scenes that are refused: each with the field that is wrong and what would be right."""

import math
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.closed_loops import four_bars, parallel_cranks
from tests.solver.kinds.refusals import (
    Refused,
    assert_points,
    assert_refused,
    at,
    both,
    changed,
    without,
)

SCENE: dict[str, Any] = {
    "kind": "simulate",
    "scene": presets.document("seven-bar-press"),
    "duration": 2.0,
}
A = "/scene/joints/A"
BAD_SCENES: dict[str, Refused] = {
    "unknown body": (at(f"{A}/bearing", "crank9.pin"), f"{A}/bearing", "crank"),
    "a number that a parameter alone gives": (
        without(f"{A}/clearance/radial_clearance"),
        f"{A}/clearance/radial_clearance",
        "required. The parameter 'clearance' replaces it, but a scene is complete without",
    ),
    "unknown point": (at(f"{A}/journal", "link2.Z"), f"{A}/journal", "point"),
    "malformed reference": (at(f"{A}/journal", "link2"), f"{A}/journal", ""),
    "unknown field": (at(f"{A}/slack", 1.0), f"{A}/slack", "There is no field"),
    "unknown joint type": (at(f"{A}/type", "ball"), f"{A}/type", ""),
    "unknown law": (
        at(f"{A}/clearance/contact/law", "glue"),
        f"{A}/clearance/contact/law",
        "lankarani-nikravesh",
    ),
    "negative mass": (at("/scene/bodies/link2/mass", -1.0), "/scene/bodies/link2/mass", "at least"),
    "zero inertia": (
        at("/scene/bodies/link2/inertia", 0.0),
        "/scene/bodies/link2/inertia",
        "at least",
    ),
    "negative clearance": (
        at(f"{A}/clearance/radial_clearance", -1e-4),
        f"{A}/clearance/radial_clearance",
        "at least",
    ),
    "point not a pair": (
        at("/scene/bodies/link2/points/A", [0.0]),
        "/scene/bodies/link2/points/A",
        "2",
    ),
    "driver of nothing": (
        at("/scene/drivers/drive1/joint", "O9"),
        "/scene/drivers/drive1/joint",
        "O",
    ),
    "driver of a joint with play": (
        at("/scene/drivers/drive1/joint", "A"),
        "/scene/drivers/drive1/joint",
        "clearance",
    ),
    "two drivers of a joint": (
        at("/scene/drivers/drive4/joint", "O1"),
        "/scene/drivers",
        "more than one",
    ),
    "both ends on one body": (at(f"{A}/bearing", "link2.C"), A, "two bodies"),
    "output of nothing": (
        at("/scene/outputs/0/channel", "slider7.z"),
        "/scene/outputs/0/channel",
        "slider7",
    ),
    "output with a taken name": (
        at("/scene/outputs/0/name", "velocity"),
        "/scene/outputs/0/name",
        "taken",
    ),
    "parameter to nowhere": (
        at("/scene/parameters/clearance/targets/0/path", "/joints/Q/clearance/radial_clearance"),
        "/scene/parameters/clearance/targets/0/path",
        "nowhere",
    ),
    "reported of no channel": (
        at("/scene/reported/0/channel", "displacment"),
        "/scene/reported/0/channel",
        "'displacement'",
    ),
    "reported in another unit": (
        at("/scene/reported/0/unit", "kN"),
        "/scene/reported/0/unit",
        "in m, not kN",
    ),
    "reported of a run that there is not": (
        both(
            at("/scene/parameters/clearance/maximum", None),
            at("/scene/reported/0/parameters", {"clearance": 2.0}),
        ),
        "/scene/reported/0/parameters",
        "do not fit",
    ),
    "parameter to a field that there is not": (
        at("/scene/parameters/stiffness/targets/0/path", f"{A}/clearance/contact/stifness"[6:]),
        "/scene/parameters/stiffness/targets/0/path",
        "leads nowhere",
    ),
    "parameter to the start of no body": (
        at("/scene/parameters/stiffness/targets/0/path", "/start/angles/link9"),
        "/scene/parameters/stiffness/targets/0/path",
        "leads nowhere",
    ),
    "material beside a stiffness": (
        both(
            at("/scene/parameters", {}),
            at(f"{A}/clearance/contact/stiffness", 1e10),
            at(f"{A}/clearance/contact/poisson_ratio", 0.3),
        ),
        f"{A}/clearance/contact/poisson_ratio",
        "'poisson_ratio' has no effect beside a given 'stiffness'",
    ),
    "parameter to what is no pointer": (
        at("/scene/parameters/clearance/targets/0/path", "joints/A/clearance/radial_clearance"),
        "/scene/parameters/clearance/targets/0/path",
        "must be a JSON pointer into the scene",
    ),
    "parameter that a required one overrides": (
        at("/scene/parameters/speed_crank4/required", True),
        "/scene/parameters/speed_crank4/targets/0/path",
        "what 'speed' before it sets here has no effect",
    ),
    "parameter that sets nought": (
        at("/scene/parameters/clearance/targets/0/factor", 0.0),
        "/scene/parameters/clearance/targets/0/factor",
        "sets 0 whatever 'clearance' is",
    ),
    "parameter that sets one number twice": (
        at(
            "/scene/parameters/clearance/targets/1/path",
            "/joints/A/clearance/radial_clearance",
        ),
        "/scene/parameters/clearance/targets/1/path",
        "twice; name it once",
    ),
    "parameter that sets the default of another": (
        at("/scene/parameters/friction/targets/0/path", "/parameters/clearance/default"),
        "/scene/parameters/friction/targets/0/path",
        "no effect on the mechanism",
    ),
    "least value of words": (
        at("/scene/parameters/slip_velocity/minimum", 0.0),
        "/scene/parameters/slip_velocity/minimum",
        "are words",
    ),
    "factor of words": (
        at("/scene/parameters/slip_velocity/targets/1/factor", 2.0),
        "/scene/parameters/slip_velocity/targets/1/factor",
        "are words",
    ),
    "no word to choose": (
        at("/scene/parameters/slip_velocity/choices", []),
        "/scene/parameters/slip_velocity/choices",
        "at least 1",
    ),
    "start of an unknown body": (
        at("/scene/start/angles/link9", 0.0),
        "/scene/start/angles/link9",
        "link",
    ),
    "reserved name": (
        both(
            at("/scene/bodies/energy", {"mass": 1.0, "inertia": 1.0, "points": {"p": [0.0, 0.0]}}),
            at(
                "/scene/joints/J",
                {"type": "fixed", "base": "link2.A", "part": "energy.p", "angle": 0.0},
            ),
        ),
        "/scene/bodies/energy",
        "reserved",
    ),
    "not a number": (at("/scene/gravity/0", math.nan), "/scene/gravity/0", "finite"),
    "body that nothing holds": (
        at("/scene/bodies/lost", {"mass": 1.0, "inertia": 1.0}),
        "/scene/bodies/lost",
        "No joint holds",
    ),
    "over-constrained": (
        at(
            "/scene/joints/extra",
            {"type": "fixed", "base": "ground.O1", "part": "slider7.D", "angle": 0.0},
        ),
        "/scene/joints",
        "over-constrained",
    ),
    "redundant": (
        at(
            "/scene/joints/extra",
            {
                "type": "prismatic",
                "guide": "ground.O1",
                "slider": "slider7.D",
                "axis": [2.0, 0.0],
                "angle": 3.141592653589793,
            },
        ),
        "/scene/joints",
        "over-constrained",
    ),
    "a parameter in millimetres that count as metres": (
        at("/scene/parameters/clearance/unit", "mm"),
        "/scene/parameters/clearance/unit",
        "count in m",
    ),
    "a period beside drivers that repeat": (
        at("/scene/period", 0.5),
        "/scene/period",
        "repeats after 2 s",
    ),
    "links that do not reach": (
        at("/scene/bodies/link2/points/C", [3.0, 0.0]),
        "/scene/start/angles",
        "does not close",
    ),
}


@pytest.mark.parametrize("case", BAD_SCENES)
def test_a_bad_scene_is_refused_at_its_field(case: str) -> None:
    change, pointer, words = BAD_SCENES[case]
    assert_refused(changed(SCENE, change), pointer, words)


def test_a_parameter_may_have_millimetres_that_a_factor_converts() -> None:
    scene = presets.document("slider-crank")
    parameter = scene["parameters"]["clearance"]
    parameter |= {"unit": "mm", "default": 0.5, "maximum": 10.0}
    parameter["targets"][0]["factor"] = 1e-3
    admit(of_scene(scene))


def of_scene(scene: dict[str, Any]) -> dict[str, Any]:
    return {"kind": "simulate", "scene": scene, "duration": 1.0}


@pytest.mark.parametrize("joint", ["A", "B"])
def test_a_loop_may_stay_closed_and_move(joint: str) -> None:
    scene = {"preset": "seven-bar-press", "parameters": {f"clearance_{joint}": 0.0}}
    assert admit(of_scene(scene)).joints == ("B" if joint == "A" else "A",)


@pytest.mark.parametrize("count", [3, 5])
def test_constraints_may_be_redundant_where_they_stay_so(count: int) -> None:
    assert admit(of_scene(parallel_cranks(count))).joints == ()


def test_an_output_of_no_channel_is_refused_before_long_equations_are_recorded() -> None:
    scene = four_bars(5, 1.0) | {"outputs": [{"name": "tip", "channel": "x"}]}
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 0.1})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/outputs/0/channel"
    assert "There is no channel 'x'" in problem.detail


def test_a_start_where_assemblies_meet_is_refused() -> None:
    scene = four_bars(1, 1.0)
    scene["start"]["angles"] = {"B0": 0.0, "B1": 0.0, "C0": 0.0}
    with pytest.raises(InvalidInput) as refused:
        admit(of_scene(scene))
    assert_points(refused.value, "/scene/start/angles", "more than one assembly")


def test_a_structure_that_gives_way_only_by_its_first_derivatives_is_refused() -> None:
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    ends = ("ground.a", "one.a"), ("one.b", "two.a"), ("two.b", "ground.b")
    joints = {
        f"J{i}": {"type": "revolute", "bearing": first, "journal": second}
        for i, (first, second) in enumerate(ends)
    }
    ground = {"points": {"a": [0.0, 0.0], "b": [2.0, 0.0]}}
    scene = {"name": "taut", "ground": ground, "bodies": {"one": rod, "two": rod}, "joints": joints}
    with pytest.raises(InvalidInput) as refused:
        admit(of_scene(scene))
    assert_points(refused.value, "/scene/joints", "over-constrained")
