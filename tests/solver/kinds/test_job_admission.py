"""Jobs and scenes that are refused: each with the field that is wrong and what would be right."""

import copy
import math
from collections.abc import Callable
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.closed_loops import four_bars, parallel_cranks

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {}},
    "duration": 2.0,
}
SCENE: dict[str, Any] = {
    "kind": "simulate",
    "scene": presets.document("seven-bar-press"),
    "duration": 2.0,
}


def at(path: str, value: Any) -> Callable[[dict[str, Any]], None]:
    """Return a change: put a value at a path."""

    def change(document: dict[str, Any]) -> None:
        *parents, last = path.strip("/").split("/")
        place: Any = document
        for key in parents:
            place = place[int(key)] if isinstance(place, list) else place[key]
        place[int(last) if isinstance(place, list) else last] = value

    return change


def without(path: str) -> Callable[[dict[str, Any]], None]:
    """Return a change: take away what is at a path."""

    def change(document: dict[str, Any]) -> None:
        *parents, last = path.strip("/").split("/")
        for key in parents:
            document = document[key]
        del document[last]

    return change


def both(*changes: Callable[[dict[str, Any]], None]) -> Callable[[dict[str, Any]], None]:
    def change(document: dict[str, Any]) -> None:
        for one in changes:
            one(document)

    return change


P = "/scene/parameters"
BAD_JOBS: dict[str, tuple[Callable[[dict[str, Any]], None], str, str]] = {
    "unknown kind": (at("/kind", "optimise"), "/kind", "simulate"),
    "no kind": (without("/kind"), "/kind", "required"),
    "no scene": (without("/scene"), "/scene", "required"),
    "no duration": (without("/duration"), "/duration", "required"),
    "unknown field": (at("/durations", 1.0), "/durations", "did you mean 'duration'"),
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
    "long label": (at("/label", "x" * 201), "/label", "200"),
}


@pytest.mark.parametrize("case", BAD_JOBS)
def test_a_bad_job_is_refused_at_its_field(case: str) -> None:
    change, pointer, words = BAD_JOBS[case]
    document = copy.deepcopy(JOB)
    change(document)
    with pytest.raises(InvalidInput) as refused:
        admit(document)
    assert_points(refused.value, pointer, words)


def assert_points(error: InvalidInput, pointer: str, words: str) -> None:
    found = {problem.pointer: problem.detail for problem in error.problems}
    assert pointer in found, found
    assert words in found[pointer], found[pointer]
    for problem in error.problems:
        assert problem.detail.endswith((".", "?")), problem
        assert "\n" not in problem.detail


A = "/scene/joints/A"
BAD_SCENES: dict[str, tuple[Callable[[dict[str, Any]], None], str, str]] = {
    "unknown body": (at(f"{A}/bearing", "crank9.pin"), f"{A}/bearing", "crank"),
    "unknown point": (at(f"{A}/journal", "link2.Z"), f"{A}/journal", "point"),
    "malformed reference": (at(f"{A}/journal", "link2"), f"{A}/journal", ""),
    "unknown field": (at(f"{A}/slack", 1.0), f"{A}/slack", "There is no field"),
    "unknown joint type": (at(f"{A}/type", "ball"), A, ""),
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
    "links that do not reach": (
        at("/scene/bodies/link2/points/C", [3.0, 0.0]),
        "/scene/start/angles",
        "does not close",
    ),
}


@pytest.mark.parametrize("case", BAD_SCENES)
def test_a_bad_scene_is_refused_at_its_field(case: str) -> None:
    change, pointer, words = BAD_SCENES[case]
    document = copy.deepcopy(SCENE)
    change(document)
    with pytest.raises(InvalidInput) as refused:
        admit(document)
    assert_points(refused.value, pointer, words)


def of_scene(scene: dict[str, Any]) -> dict[str, Any]:
    return {"kind": "simulate", "scene": scene, "duration": 1.0}


@pytest.mark.parametrize("joint", ["A", "B"])
def test_a_loop_may_stay_closed_and_move(joint: str) -> None:
    document = copy.deepcopy(JOB)
    document["scene"]["parameters"] = {f"clearance_{joint}": 0.0}
    assert admit(document).joints == ("B" if joint == "A" else "A",)


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


@pytest.mark.parametrize("document", [None, [], "job", 3.0, {}, {"scene": []}, {"scene": None}])
def test_what_is_no_job_is_refused(document: object) -> None:
    with pytest.raises(InvalidInput):
        admit(document)


def test_every_problem_is_reported_at_once() -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({**JOB, "duration": -1.0, "tolerance": 2.0, "extra": 1})
    assert {p.pointer for p in refused.value.problems} == {"/duration", "/tolerance", "/extra"}


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
