"""Seven companions of a trajectory, in the other lanes of its bundle.

Four make a ladder of tolerances; three start a little beside the scene's start, by about the error
that one step may make. None of them is the trajectory itself: companions of its own tolerance show
what its own error is like.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.periods import SAMPLES, look_ahead, plan, stop
from jointplay.solver.kernels.loop.problem import LaneProblem, LaneStart
from jointplay.solver.kernels.loop.state import Counter, Setting, Status
from jointplay.solver.runs.certificate.instants import Instants
from jointplay.solver.runs.starts import Perturbation, perturbed_start, start_scales

Floats = NDArray[np.float64]

RUN = 0
"""Lane of the trajectory itself."""
RATIO = 2.0
LADDER = (RATIO**-2, RATIO**-1, RATIO, RATIO**2)
"""Tolerances of lanes 1 to 4, in the run's own; the first decides what all this costs."""
TIGHTEST, TIGHTER = 1, 2
LOOSER = (3, 4)
PERTURBED = (5, 6, 7)
"""Lanes with the run's own tolerance and another start."""
SEED = 5
SHORT = 4.0
"""Runs of fewer periods record extremes in fewer lanes: there each record costs most."""
LOUD, LOUD_IN_SHORT = (TIGHTEST, TIGHTER, *PERTURBED), (TIGHTEST, PERTURBED[0])
"""Lanes that seek extremes."""
MOST_ATTEMPTS = 1.6
"""Of the run's own: companions that need more are left behind where they are."""


@dataclass
class Companions:
    """Lanes 1 to 7 of a bundle: `collect` after every advance, `allowance` before.

    Attributes
    ----------
    rows
        By lane, dense states at the instants reached so far.
    """

    bundle: Bundle
    instants: Instants
    loud: tuple[int, ...]
    rows: dict[int, list[Floats]]

    @classmethod
    def beside(cls, bundle: Bundle, problem: LaneProblem) -> Companions:
        """Load companions of the trajectory that a bundle has in its first lane."""
        period = float(bundle.settings[Setting.PERIOD, RUN])
        instants = Instants.over(problem.duration, period)
        start = bundle.state_of(RUN)
        coarse = replace(
            problem,
            output_step=instants.finest,
            samples=instants.last + 1,
            sections=0,
            start=LaneStart(start.state),
        )
        order = bundle.kernel.tableau.order
        for lane, factor in enumerate(LADDER, start=1):
            step = problem.step and problem.step * factor ** (1.0 / order)
            rung = replace(coarse, tolerance=problem.tolerance * factor, step=step)
            bundle.load(lane, rung, like=RUN)
        half = len(start.state) // 2
        scales = start_scales(problem.scene, bundle.kernel.coordinates, period)
        perturbation = Perturbation(problem.tolerance, SEED)
        for member, lane in enumerate(PERTURBED, start=1):
            beside = perturbed_start(
                start.state[:half], start.state[half:], scales, perturbation, member
            )
            bundle.load(lane, replace(coarse, start=LaneStart(np.concatenate(beside))), like=RUN)
        loud = LOUD if problem.duration >= SHORT * period else LOUD_IN_SHORT
        rows = bundle.kernel.rows.scanned
        for lane in range(1, LANES):
            if lane not in loud:  # no value is a record
                bundle.table("highest0", rows)[:, lane] = math.inf
                bundle.table("lowest0", rows)[:, lane] = -math.inf
        return cls(bundle, instants, loud, {lane: [] for lane in range(1, LANES)})

    @property
    def running(self) -> bool:
        """Whether any has not come to its end."""
        return bool((self.bundle.counters[Counter.STATUS, 1:] == Status.RUNNING).any())

    @property
    def time(self) -> float:
        """Simulated time that all have reached that still run, s."""
        running = self.bundle.counters[Counter.STATUS] == Status.RUNNING
        times = [self.bundle.time(lane) for lane in range(1, LANES) if running[lane]]
        return min(times, default=self.instants.duration)

    def allowance(self, budget: int) -> int:
        """Return how many attempts may be made now, and stop who has made all that it may.

        Attempts are each lane's own, so that where a companion is left behind does not depend on
        how the run was sliced.
        """
        if self.bundle.counters[Counter.STATUS, RUN] == Status.RUNNING:
            return budget
        most = math.ceil(MOST_ATTEMPTS * self.attempts(RUN))
        for lane in range(1, LANES):
            if self.bundle.counters[Counter.STATUS, lane] != Status.RUNNING:
                continue
            left = most - self.attempts(lane)
            if left > 0:
                budget = min(budget, left)
                continue
            stop(lane, Status.STEP_LIMIT, self.bundle.slots, self.bundle.work, self.bundle.counters)
        return budget

    def attempts(self, lane: int) -> int:
        """Return how many steps a lane has tried."""
        rejected = int(self.bundle.counters[Counter.REJECTIONS, lane])
        return int(self.bundle.table("steps")[0, lane]) + rejected

    def collect(self) -> None:
        """Keep the rows that were handed out, and let later instants lie farther apart."""
        counters, settings = self.bundle.counters, self.bundle.settings
        for lane in range(1, LANES):
            count = int(counters[Counter.SAMPLE_ROWS, lane])
            if not count:
                continue
            rows = self.bundle.sample_rows[lane, :count]
            stride = round(settings[Setting.OUTPUT_STEP, lane] / self.instants.finest)
            following = int(counters[Counter.SAMPLE, lane])
            coarser = self.instants.stride(min(following * stride, self.instants.last))
            if coarser > stride:
                index = range((following - count) * stride, following * stride, stride)
                rows = rows[[i % self.instants.stride(i) == 0 for i in index]]
                self._coarsen(lane, following, stride, coarser)
            self.rows[lane].append(rows.copy())

    def _coarsen(self, lane: int, following: int, stride: int, coarser: int) -> None:
        bundle = self.bundle
        bundle.settings[Setting.OUTPUT_STEP, lane] = coarser * self.instants.finest
        bundle.counters[Counter.SAMPLE, lane] = -(-following * stride // coarser)
        bundle.counters[Counter.SAMPLES, lane] = self.instants.last // coarser + 1
        state = (bundle.slots, bundle.work, bundle.settings)
        look_ahead(SAMPLES, lane, *state, bundle.counters)
        plan(lane, *state)

    def checkpoint(self) -> dict[str, NDArray[Any]]:
        """Return arrays that `restore` takes; the lanes' own state is the bundle's."""
        return {f"companion{lane}": self.dense(lane) for lane in self.rows}

    def restore(self, saved: Mapping[str, NDArray[Any]]) -> None:
        """Continue from a checkpoint."""
        self.rows = {lane: [saved[f"companion{lane}"]] for lane in self.rows}

    def dense(self, lane: int) -> Floats:
        """Return a lane's dense states, (instants reached, width)."""
        width = self.bundle.sample_rows.shape[2]
        return np.concatenate([np.zeros((0, width)), *self.rows[lane]])

    def values(self, columns: NDArray[np.int64]) -> Floats:
        """Return channels of lanes 1 to 7, (7, instants, columns); not a number: not reached."""
        found = np.full((LANES - 1, len(self.instants.index), len(columns)), np.nan)
        for lane in range(1, LANES):
            rows = self.dense(lane)
            found[lane - 1, : len(rows)] = self.bundle.observe(lane, rows, columns)
        return found
