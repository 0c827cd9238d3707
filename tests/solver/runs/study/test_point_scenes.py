"""The scene of a point is what reading the whole document with its values would give."""

import copy
import math
import pickle
import sys
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit, parse
from jointplay.solver.kinds.limits import MOST_GEOMETRIES
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Parameter, Scene
from jointplay.solver.scene.parameters import set_parameters
from tests.presets_given import REQUIRED
from tests.solver.runs.study.jobs_of_studies import BIFURCATION, PRESS, STUDIES, study

SCENES = {name: Scene.model_validate(presets.document(name)) for name in presets.names()}


def numeric(scene: Scene) -> list[str]:
    return [name for name, p in scene.parameters.items() if p.choices is None]


def values(parameter: Parameter) -> st.SearchStrategy[float]:
    """Values inside and outside a parameter's range, its ends, and those that decide structure."""
    low, high = parameter.minimum, parameter.maximum
    assert low is not None
    assert high is not None
    inside = st.floats(low, high)
    if low > 0.0:  # as many small as large ones
        inside = st.floats(0.0, 1.0).map(lambda u: min(max(low * (high / low) ** u, low), high))
    ends = [low, high, 0.0, 1.5, -1.0, high * 1.0000001]
    if isinstance(parameter.default, float):
        ends += [parameter.default, parameter.default * 1.01]
    return inside | st.sampled_from(ends)


@st.composite
def sweeps(draw: st.DrawFn) -> dict[str, Any]:
    """A sweep over random points of up to three parameters of a preset."""
    name = draw(st.sampled_from(sorted(SCENES)))
    scene = SCENES[name]
    varied = draw(st.lists(st.sampled_from(numeric(scene)), min_size=1, max_size=3, unique=True))
    point = st.fixed_dictionaries({p: values(scene.parameters[p]) for p in varied})
    points = draw(st.lists(point, min_size=1, max_size=6))
    fixed = dict(REQUIRED.get(name, {}))
    if draw(st.booleans()) and "stiffness" in scene.parameters:
        fixed["stiffness"] = 5e9
    fixed = {key: value for key, value in fixed.items() if key not in varied}
    return {
        "kind": "sweep",
        "scene": {"preset": name, "parameters": fixed},
        "points": points,
        "duration": 1e-3,
        "channels": ["energy.*"],
    }


def alone(sweep: dict[str, Any], point: dict[str, float]) -> dict[str, Any]:
    """The job of one point as a single run."""
    preset, fixed = sweep["scene"]["preset"], sweep["scene"]["parameters"]
    scene = {"preset": preset, "parameters": {**fixed, **point}}
    return {"kind": "simulate", "scene": scene, "duration": sweep["duration"]}


def is_refused(job: dict[str, Any]) -> bool:
    try:
        admit(job)
    except InvalidInput:
        return True
    return False


@given(sweeps())
def test_a_study_refuses_just_those_points_that_are_refused_alone(sweep: dict[str, Any]) -> None:
    bad = {
        index
        for index, point in enumerate(sweep["points"])
        if is_refused(alone(sweep, point)) or is_ideal(alone(sweep, point))
    }
    try:
        found = study(sweep)
    except InvalidInput as error:
        if any("changes nothing here" in problem.detail for problem in error.problems):
            return  # a parameter that others override: every point would be the same
        assert bad
        pointers = [problem.pointer for problem in error.problems]
        named = {int(p.split("/")[2]) for p in pointers if p.startswith("/points/")}
        assert named <= bad
        assert named or bad == set(range(len(sweep["points"])))  # else it is the scene's fault
    else:
        assert not bad
        assert_scenes_equal_full_validation(found)


def is_ideal(job: dict[str, Any]) -> bool:
    """Whether nothing is left to integrate: a run, but no point of a study."""
    return assemble(admit(job).scene).freedom_with_play == 0


def assert_scenes_equal_full_validation(found: Study) -> None:
    name = found.job["scene"]["preset"]
    document, declared = presets.document(name), SCENES[name]
    for point in range(found.points):
        chosen = dict(zip(found.parameters, found.values[point].tolist(), strict=True))
        given = {**found.job["scene"]["parameters"], **chosen}
        read = Scene.model_validate(set_parameters(document, declared, given)[0])
        copied = found.point_scene(point)
        assert copied == read
        assert copied.model_dump_json() == read.model_dump_json()
        assert Scene.model_validate(copied.model_dump()) == copied


def test_the_scene_a_copy_came_from_stays_as_it_was() -> None:
    found = study(BIFURCATION)
    before = found.point_scene(0).model_dump_json()
    for point in range(found.points):
        found.point_scene(point)
    assert found.point_scene(0).model_dump_json() == before
    assert Scene.model_validate(found.scene_document()) == found.point_scene(0)


def test_a_later_parameter_overrides_an_earlier_one_at_every_point() -> None:
    scene = {"preset": "seven-bar-press", "parameters": {"clearance_B": 2e-4}}
    found = study(BIFURCATION, scene=scene)
    clearances = [
        [found.point_scene(point).joints[j].clearance.radial_clearance for j in "AB"]
        for point in range(3)
    ]
    assert clearances == [[1e-4, 2e-4], [3e-4, 2e-4], [5e-4, 2e-4]]


def test_a_factor_of_a_target_counts_at_every_point() -> None:
    found = study(BIFURCATION, parameter="speed", values=[2.0, 3.0])
    speeds = [[d.speed for d in found.point_scene(p).drivers.values()] for p in range(2)]
    assert speeds == [[2.0, -2.0], [3.0, -3.0]]
    assert found.period.tolist() == pytest.approx([3.141592653589793, 2.0943951023931953])


def test_a_parameter_of_a_whole_scene_varies_like_one_of_a_preset() -> None:
    scene = presets.document("seven-bar-press")
    scene["parameters"]["stiffness"]["default"] = 5e9
    whole, preset = study(BIFURCATION, scene=scene), study(BIFURCATION)
    for point in range(3):
        written = whole.point_scene(point).model_dump(exclude={"parameters"})
        assert written == preset.point_scene(point).model_dump(exclude={"parameters"})
    assert study(whole.job).digest == whole.digest


def test_geometry_may_vary_and_each_one_is_put_together() -> None:
    scene = copy.deepcopy(presets.document("seven-bar-press"))
    scene["parameters"]["reach"] = {
        "help": "Length of link 6 beyond its centre.",
        "unit": "m",
        "default": 0.55,
        "minimum": 0.0,
        "maximum": 10.0,
        "targets": [{"path": "/bodies/link6/points/D/0"}],
    }
    job = {**BIFURCATION, "scene": scene, "parameter": "reach"}
    assert study(job, values=[0.5, 0.55, 0.6]).structure.tolist() == [0, 0, 0]
    short = {**scene, "parameters": {**scene["parameters"]}}
    short["parameters"]["reach"] = {
        **scene["parameters"]["reach"],
        "targets": [{"path": "/bodies/link2/points/C/0"}],
    }
    with pytest.raises(InvalidInput) as refused:
        study(job, scene=short, values=[0.34, 0.35, 3.0])
    assert [p.pointer for p in refused.value.problems] == ["/values/2"]
    assert "does not close" in refused.value.problems[0].detail


def test_more_geometries_than_can_be_put_together_are_refused_with_their_number() -> None:
    scene = presets.document("seven-bar-press")
    scene["parameters"]["speed"]["targets"] = [{"path": "/bodies/link6/points/D/0"}]
    values = {"from": 0.5, "to": 0.6, "count": MOST_GEOMETRIES + 1}
    with pytest.raises(LimitExceeded) as refused:
        study(BIFURCATION, scene=scene, parameter="speed", values=values)
    assert f"{MOST_GEOMETRIES + 1} geometries" in refused.value.problems[0].detail


@pytest.mark.parametrize("kind", STUDIES)
def test_a_study_can_be_sent_to_another_process(kind: str) -> None:
    found = study(STUDIES[kind])
    again = pickle.loads(pickle.dumps(found))
    assert again.digest == found.digest
    assert again.point_scene(found.points - 1) == found.point_scene(found.points - 1)


@pytest.mark.parametrize("kind", STUDIES)
def test_a_study_admitted_again_is_the_same_study(kind: str) -> None:
    first = study(STUDIES[kind])
    for again in (study(first.job), parse(first.job)):
        assert isinstance(again, Study)
        assert (again.job, again.digest) == (first.job, first.digest)
        assert again.point_scene(0) == first.point_scene(0)
        assert (again.blocks, again.chain_order) == (first.blocks, first.chain_order)
        assert again.values.tolist() == first.values.tolist()
        assert again.structure.tolist() == first.structure.tolist()
        assert again.duration.tolist() == first.duration.tolist()
        assert again.observables == first.observables


def calls(function: Callable[[], object]) -> int:
    """Return how many Python functions a function calls: a cost that no machine's load changes."""
    number = 0

    def count(_frame: object, event: str, _argument: object) -> None:
        nonlocal number
        number += event == "call"

    sys.setprofile(count)
    try:
        function()
    finally:
        sys.setprofile(None)
    return number


@pytest.mark.parametrize("parameter", ["friction", "clearance", "restitution"])
def test_ten_thousand_values_are_admitted_together(parameter: str) -> None:
    spread = {"from": 1e-4, "to": 4e-3, "count": 10_000}
    job = {**BIFURCATION, "parameter": parameter, "values": spread}
    found = study(job)
    # six a point, where blocks are planned; the check of a single scene makes over two thousand
    assert calls(lambda: study(job)) < 10 * 10_000
    assert calls(lambda: found.point_scene(5_000)) < 200  # 64: it is built, not checked


def test_points_are_numbered_by_their_structure() -> None:
    friction = study(BIFURCATION, parameter="friction", values=[0.0, 0.1, 0.0, 0.2])
    assert friction.structure.tolist() == [0, 1, 0, 1]
    exponent = study(BIFURCATION, parameter="exponent", values=[1.4, 1.5, 1.3])
    assert exponent.structure.tolist() == [0, 1, 0]
    assert study(BIFURCATION).structure.tolist() == [0, 0, 0]
    grid = {"friction": [0.0, 0.1], "exponent": [1.5, 1.3]}
    sweep = study(STUDIES["sweep"], grid=grid, scene=PRESS)
    assert sweep.structure.tolist() == [0, 1, 2, 3]


def punched(parameter: str, target: str) -> dict[str, Any]:
    """A slider-crank with play that a punch resists, and whose knots a parameter sets."""
    scene = presets.document("slider-crank")
    scene["forces"] = {
        "punch": {
            "type": "force",
            "first": "ground.O",
            "second": "slider.pin",
            "magnitude": 10.0,
            "direction": [1.0, 0.0],
            "over": {"quantity": "driver", "driver": next(iter(scene["drivers"]))},
            "course": {
                "type": "table",
                "knots": [0.0, 2.0, 4.0, 6.2831853],
                "values": [0.0, 1.0, 0.5, 0.0],
                "outside": "periodic",
            },
        }
    }
    path = f"/forces/punch/course/knots/{target}"
    scene["parameters"][parameter] = {"help": "A knot.", "targets": [{"path": path}]}
    return scene


@pytest.mark.parametrize("knot", [6.2831853, 3.1415927, 2.0 * math.pi])
def test_a_last_knot_that_ends_a_turn_to_seven_digits_ends_it_at_every_point(knot: float) -> None:
    scene = punched("end", "3")
    scene["forces"]["punch"]["course"]["knots"][1:3] = [1.0, 2.0]
    found = study(
        {"kind": "bifurcation", "scene": scene, "parameter": "end", "settle": 1, "record": 1}
        | {"values": [knot, 2.0 * math.pi / 3.0]}
    )
    ends = [found.point_scene(p).forces["punch"].course.knots[-1] for p in range(2)]
    assert ends == [2.0 * math.pi / round(2.0 * math.pi / knot), 2.0 * math.pi / 3.0]
    written = {**scene, "parameters": {}}
    written["forces"]["punch"]["course"]["knots"][3] = knot
    assert Scene.model_validate(written).forces["punch"].course.knots[-1] == ends[0]
