"""Compiled kernels against the readable reference, their selection, and their cache on disk."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.target import ALONE
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.mechanics.observe import channel_values, ledger_rates
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from tests.solver.completed_runs import CASE_3
from tests.solver.readable_mechanics import Instant, at_start, preset

ROUNDING = 1e-12
"""Part of the largest acceleration, force or power. Both sides do the same operations on numbers of
at most 2 m; our sine and cosine differ from the library's in the last place, 2e-16, and a contact
stiffness times 2e-16 m is 1e-12 of the force at the depths drawn here, about 0.1 mm."""


def kernel_of(scene: Scene, formulation: str = "reduced") -> Kernel:
    return compile_kernel(scene, spanning_tree(scene), formulation, TSITOURAS5)


def random_instant(scene: Scene, random: np.random.Generator) -> Instant:
    """Return a scene near its start: journals about 0.1 mm inside their bearings' walls or out."""
    start = at_start(scene)
    return replace(
        start,
        position={k: q + random.uniform(-3e-4, 3e-4) for k, q in start.position.items()},
        speed={k: v + random.uniform(-0.5, 0.5) for k, v in start.speed.items()},
        mode={k: float(random.integers(0, 2)) for k in start.mode},
        impact_rate={k: random.uniform(0.01, 0.2) for k in start.mode},
    )


def evaluated(kernel: Kernel, instants: list[Instant], formulation: str) -> list[dict[str, float]]:
    """Evaluate the kernel at one instant a lane; accelerations, ledger rates and channels."""
    bundle = Bundle(kernel, [LaneProblem(i.scene, 1.0, 1e-6, 0.1, 11, 0, 0.0) for i in instants])
    count = len(kernel.coordinates)
    for lane, instant in enumerate(instants):
        if formulation == "lagrange":
            q, v = instant.absolute_state()
        else:
            q = [instant.position[name] for name in kernel.coordinates]
            v = [instant.speed[name] for name in kernel.coordinates]
        at = bundle.lane(lane)
        at["stage"], at["stage_time"] = np.array([*q, *v]), 0.25
        for k, name in enumerate(kernel.equations.drivers):
            moved = instant.scene.drivers[name].clock_rate * 0.25
            at["phase"][k] = instant.driven[name] - moved
        for j, name in enumerate(kernel.pairs):
            at["mode"][j] = instant.mode[name]
            at["impact_rate"][j] = instant.impact_rate[name]
    for group in bundle.groups:
        kernel.module.right_hand_side(group.work)
        kernel.module.observe(group.work)
        kernel.module.observe_rest(group.work)
    names = kernel.rows.names
    found = []
    for lane in range(len(instants)):
        at = bundle.lane(lane)
        values = dict(zip(names, at["channel"], strict=True))
        values |= {f"a{i}": at["slope"][count + i] for i in range(count)}
        values |= {f"v{i}": at["slope"][i] for i in range(count)}
        ledger = len(kernel.equations.ledger)
        values |= {f"ledger{i}": at["ledger"][i] for i in range(ledger)}
        values.pop("stored")
        found.append(values)
    return found


def referred(kernel: Kernel, instant: Instant, formulation: str) -> dict[str, float]:
    """Evaluate the same on floats."""
    motion = instant.reduced() if formulation == "reduced" else instant.lagrange()
    speeds = (
        [instant.speed[name] for name in kernel.coordinates]
        if formulation == "reduced"
        else (instant.absolute_state()[1])
    )
    numbers = view(instant.scene)
    found = dict(channel_values(numbers, motion))
    found |= {f"a{i}": value for i, value in enumerate(motion.accelerations)}
    found |= {f"v{i}": value for i, value in enumerate(speeds)}
    found |= {f"ledger{i}": value for i, value in enumerate(ledger_rates(numbers, motion).values())}
    return found


@pytest.mark.parametrize(
    "formulation", ["reduced", pytest.param("lagrange", marks=pytest.mark.long)]
)
def test_kernels_of_the_press_equal_the_readable_reference(formulation: str) -> None:
    random = np.random.default_rng(20)
    scenes = [
        preset(
            "seven-bar-press",
            **{
                **CASE_3,
                "clearance": 5e-4 * (1 + 0.1 * lane),
                "friction": 0.02 * (1 + lane),
                "stiffness": 1e9 * (1 + lane),
                "restitution": 0.1 * (1 + lane),
                "speed": (-1.0) ** lane * 3.0,
            },
        )
        for lane in range(BUNDLE)
    ]
    kernel = kernel_of(scenes[0], formulation)
    for _ in range(4):
        instants = [random_instant(scene, random) for scene in scenes]
        for instant, found in zip(instants, evaluated(kernel, instants, formulation), strict=True):
            expected = referred(kernel, instant, formulation)
            assert found.keys() == expected.keys()
            largest = max(1.0, *(abs(value) for value in expected.values()))
            for name, value in expected.items():
                assert found[name] == pytest.approx(value, rel=1e-12, abs=ROUNDING * largest), name


# what selects a kernel


def test_numbers_select_no_kernel() -> None:
    first = kernel_of(preset("seven-bar-press", **CASE_3))
    numbers: list[dict[str, Any]] = [
        {"clearance_A": 1e-4, "clearance_B": 7e-4},
        {"stiffness": 2e10, "restitution": 1.0, "friction": 0.7},
        {"static_velocity": 1e-3, "dynamic_velocity": 1e-3},
        {"speed": -2.0, "speed_crank4": 0.3, "gravity_x": 0.0, "gravity_y": 5.0},
        {"bearing_radius": 0.02, "impact_rate_floor": 0.1},
    ]
    for changes in numbers:
        assert (
            kernel_of(preset("seven-bar-press", **{**CASE_3, **changes})).module.prefix
            == first.module.prefix
        )


def test_a_given_stiffness_is_a_number_and_selects_no_kernel() -> None:
    without = {k: v for k, v in CASE_3.items() if k != "stiffness"}
    given, derived = (kernel_of(preset("seven-bar-press", **p)) for p in (CASE_3, without))
    assert given.module.prefix == derived.module.prefix


def test_structure_selects_the_kernel() -> None:
    scenes = [
        preset("bouncing-journal"),
        preset("bouncing-journal", friction=0.0),
        preset("bouncing-journal", friction=0.0, exponent=1.2),
    ]
    kernels = [kernel_of(scene) for scene in scenes]
    assert len({kernel.module for kernel in kernels}) == 3
    other_exponent = preset("bouncing-journal", friction=0.0, exponent=2.0)
    assert kernel_of(other_exponent).module.prefix == kernels[2].module.prefix


def test_a_process_keeps_the_kernel_of_a_structure() -> None:
    kept = ready_kernel(preset("bouncing-journal"), "reduced")
    assert ready_kernel(preset("bouncing-journal", clearance=2e-4), "reduced") is kept
    assert ready_kernel(preset("bouncing-journal"), "lagrange") is not kept
    alone = ready_kernel(preset("bouncing-journal"), "reduced", alone=True)
    assert alone.lanes == min(kept.lanes, ALONE)
    assert (alone is kept) == (kept.lanes <= ALONE)
    outputs = preset("bouncing-journal").model_dump(mode="json")
    outputs["outputs"].append(
        {"name": "twice", "channel": "journal.y", "factor": 2.0, "offset": 0.0, "help": "Twice y."}
    )
    shifted = {**outputs, "outputs": [dict(each) for each in outputs["outputs"]]}
    shifted["outputs"][-1]["offset"] = 1.0
    kernels = [ready_kernel(Scene.model_validate(each), "reduced") for each in (outputs, shifted)]
    assert [each.rows.multiples["twice"][2] for each in kernels] == [0.0, 1.0]
    given_or_derived = [preset("seven-bar-press", **p) for p in ({}, {"stiffness": 5e9})]
    assert len({id(ready_kernel(scene, "reduced")) for scene in given_or_derived}) == 2
    for scene in (preset("bouncing-journal", friction=0.0), preset("bouncing-journal")):
        assert ready_kernel(scene, "reduced").module.prefix == kernel_of(scene).module.prefix


COMPILED = """
from jointplay.solver.kinds import admit
from jointplay.solver.kernels.cache import SPENT, cache_folder
from jointplay.solver.kernels.loop_code import FOR_RUNS, path_of
from jointplay.solver.runs.simulate import Simulation

simulation = Simulation(admit({"kind": "simulate", "scene": {"preset": "bouncing-journal"},
                               "duration": 0.1}))
list(simulation.slices())
(code,) = cache_folder().glob(simulation._run.kernel.module.prefix + ".o")
print(SPENT.seconds, *((path.name, path.stat().st_mtime_ns) for path in (code, path_of(FOR_RUNS))))
"""


def compiled_in_a_process() -> tuple[str, str]:
    """Return the seconds of compiling, and when the files that it used were written."""
    done = subprocess.run(
        [sys.executable, "-c", COMPILED],
        cwd=Path(__file__).parents[3],
        capture_output=True,
        text=True,
        check=True,
    )
    seconds, _, files = done.stdout.partition(" ")
    return seconds, files


def test_a_second_process_compiles_nothing() -> None:
    (_, first), (seconds, second) = compiled_in_a_process(), compiled_in_a_process()
    assert second == first
    assert seconds == "0.0"
