"""One run of a work-precision study: what it cost, and the states that it passed."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.admission import Admission
from solver.compile_loop import ready_kernel
from solver.lanes.account import statistics_of
from solver.lanes.bundle import Bundle
from solver.lanes.problem import LaneProblem
from solver.lanes.state import Counter, Status
from solver.scene.document import Scene

Floats = NDArray[np.float64]

SAMPLES = 2000
"""Instants at which runs are compared."""
BUDGET = 20_000
"""Attempted steps between looks at the clock."""


@dataclass(frozen=True)
class Passed:
    """A run as far as it came.

    Attributes
    ----------
    time, states : (samples,) s and (samples, states)
    scales : (states,) the scene's own scales, which tolerances are relative to
    evaluations : of the equations of motion, in attempted steps
    astray : energy that the run lost track of, as a share of what contacts and friction took;
        not a number where they took nothing
    """

    complete: bool
    time: Floats
    states: Floats
    scales: Floats
    steps: int
    evaluations: int
    seconds: float
    astray: float


def pass_through(
    admission: Admission,
    method: str,
    tolerance: float,
    *,
    step: float | None = None,
    patience: float = np.inf,
) -> Passed:
    """Run an admitted simulation with any method and tolerance, also with those that it refuses.

    `step` : of a method with a fixed one, s. `patience` : seconds after which the run is given up.
    """
    scene, duration = Scene.model_validate(admission.scene), float(admission.job["duration"])
    kernel = ready_kernel(scene, admission.job["formulation"], method)
    problem = LaneProblem(
        scene, duration, tolerance, duration / SAMPLES, SAMPLES + 1, 0, 0.0, step=step
    )
    bundle = Bundle(kernel, [problem])
    scales = 1.0 / (tolerance * bundle.table("weight0", kernel.states)[:, 0])
    first = 2 + 2 * len(kernel.drivers)
    period = 0.0
    times: list[Floats] = []
    states: list[Floats] = []
    running, spent = 1, 0.0
    while running and spent <= patience:
        begun = time.perf_counter()
        running = bundle.advance(BUDGET)
        spent += time.perf_counter() - begun
        rows = bundle.sample_rows[0, : bundle.counters[Counter.SAMPLE_ROWS, 0]]
        period = float(bundle.settings[0, 0])
        times.append(rows[:, 0] * period + rows[:, 1])
        states.append(rows[:, first : first + kernel.states].copy())
    statistics = statistics_of(bundle, 0)
    energy = statistics["energy"]
    taken = energy["contact_loss"] + energy["friction_loss"]
    return Passed(
        bundle.counters[Counter.STATUS, 0] == Status.DONE,
        np.concatenate(times),
        np.concatenate(states),
        scales,
        statistics["steps"],
        bundle.attempts * kernel.tableau.evaluations(kernel.states),
        spent,
        abs(energy["residual"]) / taken if taken > 0.0 else np.nan,
    )
