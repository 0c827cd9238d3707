"""One run of an accuracy-study: what it costs, and the states that it passes."""

import time

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.energy_residual import RELATIVE_ENERGY_RESIDUAL
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.loop.runs import SAMPLES as ROWS_OF_SAMPLES
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.lane_results import failure_of, statistics_of
from jointplay.solver.runs.work_precision.plan import Run
from jointplay.solver.scene.document import Scene

SAMPLES = 2000
"""Instants at which runs are compared."""
BUDGET = 20_000
"""Attempted steps between returns."""


class TimedRun:
    """Runs a scene with the kernel of a method, also as jobs may not ask for it."""

    def __init__(self, scene: Scene, kernel: Kernel, run: Run, duration: float) -> None:
        self.scene = scene
        self.tolerance = run.tolerance or 1.0
        self.duration = duration
        problem = LaneProblem(
            scene, duration, self.tolerance, duration / SAMPLES, SAMPLES + 1, 0, 0.0, step=run.step
        )
        self.bundle = Bundle(kernel, [problem])
        self.seconds = 0.0
        """Spent computing, without compiling."""
        self._each = kernel.tableau.evaluations(kernel.states)
        self._times: list[Floats] = []
        self._states: list[Floats] = []

    @property
    def evaluations(self) -> int:
        """Evaluations of the equations of motion so far, in attempted steps."""
        return self.bundle.attempts * self._each

    @property
    def steps(self) -> int:
        """Accepted so far."""
        return self.bundle.lane(0).steps

    @property
    def fraction(self) -> float:
        """Part of the duration that is done, 0..1."""
        return min(self.bundle.lane(0).time / self.duration, 1.0)

    def advance(self) -> bool:
        """Make some steps. Returns whether more are to be made."""
        bundle = self.bundle
        begun = time.perf_counter()
        running = bundle.advance(BUDGET)
        self.seconds += time.perf_counter() - begun
        rows = bundle.rows(ROWS_OF_SAMPLES, 0)
        self._times.append(bundle.times(0, rows))
        self._states.append(bundle.kernel.row.states(rows).copy())
        return bool(running)

    def samples(self) -> tuple[Floats, Floats]:
        """Return (samples,) times, s, and (samples, states), as far as it came."""
        return np.concatenate(self._times), np.concatenate(self._states)

    def scales(self) -> Floats:
        """Return (states,) the scene's own scales, which tolerances are relative to."""
        return np.asarray(1.0 / (self.tolerance * self.bundle.lane(0)["weight"]))

    def failure(self) -> SimulationFailed | None:
        """Return why it did not come to its end."""
        if self.bundle.lane(0).status != Status.DONE:
            return failure_of(self.bundle, 0, self.tolerance, self.scene)
        states = self.samples()[1]
        if len(states) == SAMPLES + 1 and np.isfinite(states).all():
            return None
        sentence = "Its motion grew beyond all numbers. Choose another method or a smaller step."
        return SimulationFailed("not-finite", sentence, self.bundle.lane(0).time)

    def cost(self) -> dict[str, float]:
        """Return what it cost, and its energy residual."""
        found = statistics_of(self.bundle, 0)
        energy = found["energy"]
        damped = max(energy["element_loss"], 0.0)  # elements may drive instead
        taken = energy["contact_loss"] + energy["friction_loss"] + damped
        return {
            "steps": float(found["steps"]),
            "evaluations": float(self.evaluations),
            "seconds": self.seconds,
            RELATIVE_ENERGY_RESIDUAL: abs(energy["residual"]) / taken if taken > 0.0 else np.nan,
        }
