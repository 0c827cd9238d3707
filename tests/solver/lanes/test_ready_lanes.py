"""Lanes that are made ready together have the bits that each has alone, for a share of the work."""

import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from jointplay.solver.integrators import method_for
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.trace.operations import OPERATIONS, operate
from jointplay.solver.lanes import ready_lanes
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.lanes.ready_lanes import ReadyLanes, make_ready
from jointplay.solver.runs.study.scenes import Leaf, PointScenes
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import value_at

POINTS = 11
"""One more than fit side by side, at any width."""
CLEARANCE = "/joints/P/clearance/"
VARIED = {
    "slider-crank": [
        [CLEARANCE + "radial_clearance"],
        [CLEARANCE + "friction/coefficient", "/bodies/rod/mass"],
        [CLEARANCE + "contact/restitution", CLEARANCE + "friction/dynamic_velocity", "/gravity/1"],
        ["/drivers/motor/speed", CLEARANCE + "radial_clearance"],
        ["/bodies/rod/points/slider/0"],
    ],
    "bouncing-journal": [
        ["/joints/bearing/clearance/radial_clearance", "/bodies/journal/mass"],
        ["/joints/bearing/clearance/bearing_radius"],
        ["/gravity/1", "/joints/bearing/clearance/contact/stiffness"],
    ],
}
TAKES = {"add": 2, "sub": 2, "mul": 2, "div": 2, "pow": 2, "select": 3, "quarter_turns": 3}
"""Arguments of operations that take more than one."""
CASES = [(name, paths) for name, sets in VARIED.items() for paths in sets]


def scenes_of(name: str, paths: list[str], points: int = POINTS) -> PointScenes:
    """Return scenes in which numbers differ by up to a hundredth."""
    scene = Scene.model_validate(presets.document(name))
    factors = 1.0 + 0.01 * np.random.default_rng(5).uniform(-1.0, 1.0, (points, len(paths)))
    values = np.array([float(value_at(scene, path)) for path in paths]) * factors
    return PointScenes(scene, tuple(Leaf(p, i, 1.0) for i, p in enumerate(paths)), values)


def kernel_of(scenes: PointScenes) -> Any:
    return ready_kernel(scenes.base, "reduced", method_for("auto", 1e-6))


def problem(scene: Scene, point: int) -> LaneProblem:
    return LaneProblem(scene, 1.0 + 0.1 * point, 1e-6, 0.01, 5 + point, 5, 0.1)


def readied(scenes: PointScenes, kernel: Any, tangents: Any = None) -> ReadyLanes:
    together = scenes.together()
    problems = [problem(together, point) for point in range(len(scenes.values))]
    return make_ready(kernel, tangents, problems, scenes.scene)


def bits(bundle: Bundle) -> tuple[bytes, bytes, bytes]:
    work = bundle.groups[0].work[:, 0]
    return work.tobytes(), bundle.runs[0].tobytes(), bundle.first_energy[:, 0].tobytes()


@pytest.mark.parametrize(("name", "paths"), CASES)
def test_a_lane_has_the_bits_that_it_has_alone(name: str, paths: list[str]) -> None:
    scenes = scenes_of(name, paths)
    kernel = kernel_of(scenes)
    tangents = compile_tangents(kernel) if name == "slider-crank" else None
    lanes = readied(scenes, kernel, tangents)
    for point in range(POINTS):
        alone, beside = (Bundle(kernel, tangents=tangents) for _ in range(2))
        alone.load(0, problem(scenes.scene(point), point))
        beside.load_ready(0, lanes, point)
        assert bits(beside) == bits(alone)


@pytest.mark.parametrize("name", ["slider-crank", "seven-bar-press"])
@pytest.mark.parametrize("step", [None, 1e-5])
def test_lanes_that_go_on_elsewhere_have_the_bits_that_each_has_alone(
    name: str, step: float | None
) -> None:
    """Companions of one scene: of other tolerances, steps, instants and contacts."""
    scenes = scenes_of(name, [])
    kernel = kernel_of(scenes)
    tangents = compile_tangents(kernel) if name == "slider-crank" else None
    run = Bundle(kernel, [problem(scenes.base, 0)])
    rows = []
    for _ in range(6):
        run.advance(150)
        rows.append(run.lane(0).row()[0])
    starts = [LaneStart.at_row(row, kernel.row) for row in rows]
    assert len({start.contact.tobytes() for start in starts if start.contact is not None}) > 1
    problems = {
        lane: replace(
            problem(scenes.base, lane),
            start=start,
            tolerance=1e-6 / lane,
            step=step and step * lane,
        )
        for lane, start in enumerate(starts, start=1)
    }
    alone, beside = (Bundle(kernel, [problem(scenes.base, 0)], tangents=tangents) for _ in range(2))
    for lane, one in problems.items():
        alone.load(lane, one, like=0)
    beside.load_together(problems, like=0)
    assert beside.block("y").tobytes() == alone.block("y").tobytes()
    assert all(
        array.tobytes() == alone.state("")[name].tobytes()
        for name, array in beside.state("").items()
    )


def test_nothing_is_loaded_of_no_problems() -> None:
    bundle = Bundle(kernel_of(scenes_of("slider-crank", [])))
    bundle.load_together({})
    assert not bundle.groups[0].runs_on


def friction(dynamic: list[float]) -> PointScenes:
    """Return slider-cranks with friction whose force is full from these slip velocities on."""
    paths = [CLEARANCE + f"friction/{name}" for name in ("coefficient", "dynamic_velocity")]
    static = CLEARANCE + "friction/static_velocity"
    scene = Scene.model_validate(presets.document("slider-crank"))
    values = np.array([[0.1, float(value_at(scene, static)) * one] for one in dynamic])
    leaves = tuple(Leaf(path, i, 1.0) for i, path in enumerate(paths))
    return PointScenes(PointScenes(scene, leaves, values).scene(0), leaves, values)


@pytest.mark.parametrize("dynamic", [[1.0, 2.0, 1.0, 3.0], [1.0, 1.0], [2.0, 3.0]])
def test_no_tangent_follows_a_lane_whose_friction_jumps(dynamic: list[float]) -> None:
    scenes = friction(dynamic)
    kernel = kernel_of(scenes)
    tangents = compile_tangents(kernel)
    lanes = readied(scenes, kernel, tangents)
    for point, multiple in enumerate(dynamic):
        alone, beside = (Bundle(kernel, tangents=tangents) for _ in range(2))
        alone.load(0, problem(scenes.scene(point), point))
        beside.load_ready(0, lanes, point)
        assert bits(beside) == bits(alone)
        jumps = np.isnan(beside.lane(0)["tangent"])
        assert jumps.all() if multiple == 1.0 else not jumps.any()


@pytest.mark.parametrize(("name", "paths"), CASES)
def test_a_lane_has_the_same_bits_beside_others(name: str, paths: list[str]) -> None:
    scenes = scenes_of(name, paths)
    kernel = kernel_of(scenes)
    lanes = readied(scenes, kernel)
    some = np.array([9, 2, 5])
    fewer = scenes.at_rows(some)
    scene = fewer.together()
    beside = make_ready(kernel, None, [problem(scene, int(p)) for p in some], fewer.scene)
    assert beside.work.tobytes() == lanes.work[some].tobytes()
    assert beside.runs.tobytes() == lanes.runs[some].tobytes()


def test_a_start_is_looked_for_once_where_nothing_varies_that_it_depends_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    starts: list[Scene] = []
    whole = ready_lanes.own_start

    def noted(kernel: Any, scene: Scene, one: Scene | None = None) -> Any:
        starts.append(scene)
        return whole(kernel, scene, one)

    monkeypatch.setattr(ready_lanes, "own_start", noted)
    masses = (CLEARANCE + "radial_clearance", "/bodies/rod/mass")
    for path, count in (*((path, 1) for path in masses), ("/drivers/motor/speed", 2)):
        scenes = scenes_of("slider-crank", [path])
        starts.clear()
        readied(scenes, kernel_of(scenes))
        assert len(starts) == count  # of speeds it is asked for of one point, too


@pytest.mark.parametrize(
    "paths", [[CLEARANCE + "radial_clearance"], [CLEARANCE + "friction/coefficient", "/gravity/1"]]
)
def test_a_point_takes_few_calls_of_python(paths: list[str]) -> None:
    """Two thousand a point before points were made ready together; forty, and so many a block."""
    scenes = scenes_of("slider-crank", paths, 64)
    kernel = kernel_of(scenes)
    bundle = Bundle(kernel)
    readied(scenes, kernel)  # what is compiled or found once
    calls = 0

    def count(_frame: object, event: str, _argument: object) -> None:
        nonlocal calls
        calls += event == "call"

    sys.setprofile(count)
    try:
        lanes = readied(scenes, kernel)
        for point in range(64):
            bundle.load_ready(point % 8, lanes, point)
    finally:
        sys.setprofile(None)
    assert calls <= 64 * 70


@pytest.mark.parametrize("name", sorted(OPERATIONS))
def test_operations_have_the_bits_of_numbers_on_arrays(name: str) -> None:
    rng = np.random.default_rng(2)
    count = TAKES.get(name, 1)
    whole = name in ("quarter_turns", "power_of_two")
    operands = [rng.uniform(0.5, 9.0, 200) for _ in range(count)]
    operands[0] = np.floor(operands[0]) if whole else operands[0]
    if name == "select":
        operands[0] -= 4.0
    if name == "pow":
        operands[1][::3] = 1.5
    found = operate(name, operands)
    each = [operate(name, [float(x) for x in one]) for one in zip(*operands, strict=True)]
    assert found.tolist() == each
