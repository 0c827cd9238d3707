"""Eight runs of one scene, and the work of their steps: counted, for times are a machine's."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from jointplay.solver.kernels.emit.functions import SIGNATURES
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import SectionKind
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import Event, LaneProblem
from jointplay.solver.scene.document import Scene
from tests.solver.readable_mechanics import preset

LANES = 8
WAYS = ("bare", "extremes", "tangents", "crossings")
"""Demands on the runs beside their motion."""


@dataclass(frozen=True)
class Case:
    """A preset and what its eight runs differ in, when counting begins, and for how long."""

    preset: str
    parameter: str
    values: tuple[float, float]
    others: dict[str, float]
    crossing: str
    """Channel whose passage through 0 makes a section."""
    settle: int
    """Attempts before counting begins."""
    counted: int = 2000
    """Attempts that are counted."""


CASES = {
    "press, steady": Case(
        "seven-bar-press",
        "clearance",
        (3e-4, 6e-4),
        {"friction": 0.1, "restitution": 0.9, "bearing_radius": 0.01}
        | {"static_velocity": 1e-3, "dynamic_velocity": 1e-2},
        "slider7.vx",
        settle=30_000,
    ),
    "press, in flight": Case(
        "seven-bar-press", "clearance", (3e-4, 6e-4), {"friction": 0.1}, "slider7.vx", settle=0
    ),
    "slider-crank, impacting": Case(
        "slider-crank", "clearance", (1e-4, 5e-4), {}, "slider.vx", settle=20_000
    ),
    "driven pendulum": Case("driven-pendulum", "speed", (4.0, 9.0), {}, "rod.omega", settle=2000),
    "journal, bouncing": Case(
        "bouncing-journal", "velocity_x", (0.1, 1.0), {}, "journal.vx", settle=0
    ),
}


@dataclass(frozen=True)
class Work:
    """Work of eight runs."""

    attempts: int
    """Attempts at a step of all lanes together."""
    accepted: int
    """Accepted steps of all lanes."""
    attended: float
    """Share of the lanes' attempts after which a lane was looked after by itself."""
    calls: dict[str, float]
    """Calls of a generated function by the loop, while each of eight lanes makes an attempt."""


def count(case: Case, way: str) -> Work:
    """Return the work of a case's runs, asked for one of `WAYS`."""
    scenes = [
        preset(case.preset, **case.others, **{case.parameter: float(value)})
        for value in np.linspace(*case.values, LANES)
    ]
    kernel = ready_kernel(scenes[0], "reduced", "tsitouras")
    tangents = compile_tangents(kernel) if way == "tangents" else None
    problems = [_problem(scene, kernel, case.crossing, way) for scene in scenes]
    bundle = Bundle(kernel, problems, watch=way == "extremes", tangents=tangents)
    for _ in range(case.settle // 1000):
        bundle.advance(1000)
    modules = [kernel.module] if tangents is None else [kernel.module, tangents.module]
    before, begun = _counted(bundle), _calls(modules)
    for _ in range(case.counted // 100):  # buffers of contacts are read in between
        bundle.advance(100)
    attempts, accepted, attended = map(int, np.subtract(_counted(bundle), before))
    each = LANES / attempts
    calls = {name: (number - begun[name]) * each for name, number in _calls(modules).items()}
    return Work(attempts, accepted, attended / attempts, calls)


def _problem(scene: Scene, kernel: Kernel, crossing: str, way: str) -> LaneProblem:
    problem = LaneProblem(scene, 1e3, 1e-6, 1e3, 0, 0, 0.0)
    if way != "crossings":
        return problem
    row = kernel.rows.index(crossing)
    return replace(problem, sections=10**9, event=Event(SectionKind.CROSSING, row, sense=1.0))


def _counted(bundle: Bundle) -> tuple[int, int, int]:
    """Return attempts, accepted steps and attended attempts of all lanes, so far."""
    attempts = sum(group.attempts * group.work.shape[1] for group in bundle.groups)
    steps = sum(bundle.lane(i).number("steps") for i in range(LANES))
    return attempts, int(steps), int(bundle.runs["attended"].sum())


def _calls(modules: list[Any]) -> dict[str, int]:
    found = {}
    for name in SIGNATURES:
        functions = [getattr(module, name) for module in modules if hasattr(module, name)]
        found[name] = functions[0].call_count if functions else 0
    return found
