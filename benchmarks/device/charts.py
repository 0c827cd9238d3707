"""Whole charts on a device: revolutions a second, the last verdict included."""

import time
from collections.abc import Mapping
from typing import Any, cast

from benchmarks.device.opened import Opened
from benchmarks.device.prepare import MECHANISMS
from jointplay.solver.computations import computation_of
from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.run import StudyRun

CHARTS: Mapping[str, tuple[str, int, int, tuple[str, ...]]] = {
    "press": ("seven-bar-press", 260, 12, ("recurrence",)),
    "slider-crank": ("slider-crank", 260, 60, ("recurrence",)),
    "slider-crank, exponents": ("slider-crank", 200, 40, ("lyapunov",)),
}
"""Preset, points along each axis, revolutions of a point, and indicators."""
HERE = 4, 4
"""Points along each axis and revolutions where there is no device."""


def chart(preset: str, side: int, revolutions: int, indicators: tuple[str, ...]) -> dict[str, Any]:
    """Return a chart over the axes of `MECHANISMS`; half of the revolutions are recorded."""
    axes = [
        {"parameter": name, "values": {"from": low, "to": high, "count": side}}
        for name, (low, high) in MECHANISMS[preset].items()
    ]
    return {
        "kind": "chart",
        "scene": {"preset": preset},
        "along": axes[0],
        "by": axes[1],
        "settle": revolutions - revolutions // 2,
        "record": revolutions // 2,
        "indicators": list(indicators),
        "tolerance": 1e-6,
    }


def rates(found: Opened) -> None:
    """Print how fast each chart is, and how much of the time launches take."""
    for name, (preset, side, revolutions, indicators) in CHARTS.items():
        size = (side, revolutions) if found.there else HERE
        study = cast(Study, admit(chart(preset, *size, indicators)))
        seconds, launched, launches = computed(study, found)
        rate = study.points * size[1] / seconds
        print(
            f"chart of the {name}: {study.points} points of {size[1]} revolutions in"
            f" {seconds:.1f} s, {rate:.0f} rev/s; {launches} launches, {launched:.1f} s of it",
            flush=True,
        )


def computed(study: Study, found: Opened) -> tuple[float, float, int]:
    """Return seconds of a study and of its launches, and their number, behind the first slice."""
    pool, waiting = Pool(study, found.lanes(study), 0.3), list(range(len(study.blocks)))
    pool.add(_block(study, waiting.pop(0)))
    pool.advance()  # compiles
    begun, launched, launches = time.perf_counter(), pool.launched, 0
    while waiting or pool.runs:
        while waiting and pool.room > 0:
            pool.add(_block(study, waiting.pop(0)))
        pool.advance()
        launches += 1
    return time.perf_counter() - begun, pool.launched - launched, launches


def _block(study: Study, index: int) -> StudyRun:
    return cast(StudyRun, computation_of(study, index))
