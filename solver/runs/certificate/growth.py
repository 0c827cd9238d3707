"""A finite-time Lyapunov exponent with its spread: tangent vectors over eight windows of a run.

A tangent vector costs as much as the run that carries it. Eight at once, each over a window of its
own that begins at an eighth of the run, show in a twentieth of the steps how small deviations
grow, and how unevenly they do. Windows are apart, so that their standard error is that of as many
measurements: none goes on where the next one begins, also in a run of few steps.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.entry_points import measure_tangent
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.quantities.scalars import logarithm
from jointplay.solver.runs.certificate.companions import RUN, TIGHTEST, Companions

SHARE, FEWEST, MOST = 0.05, 200, 1_000_000
"""Steps of a window: a share of the run's, within bounds, and at most an eighth of them."""
SHORTEST = 25
"""Steps of a window below which its tangent has not turned to where growth is fastest: a run that
has no eight such windows apart has no exponent."""
ALIGNING = 0.25
"""Share of a window in which a tangent turns to the direction that grows fastest."""


@dataclass(frozen=True)
class Exponent:
    """Growth of small deviations per time, 1/s: mean over windows, its standard error, extremes."""

    value: float
    error: float
    lowest: float
    highest: float
    windows: int
    time: float
    """Length of all windows, s."""


class Windows:
    """Eight windows in the lanes of a bundle of their own: `advance` until it is over."""

    def __init__(self, companions: Companions, problem: LaneProblem, tangents: Tangents) -> None:
        """Start windows from the tightest companion's states, as far as it and the run came."""
        kernel = companions.bundle.kernel
        self.bundle = Bundle(kernel, watch=False, tangents=tangents)
        made = companions.bundle.lane(RUN).attempts
        most = made // BUNDLE
        self.attempts = int(min(max(SHARE * made, FEWEST), MOST, most if most >= SHORTEST else 0))
        self.grown = np.zeros(BUNDLE)
        self.aligned = np.full((2, BUNDLE), np.nan)
        run = companions.bundle.lane(RUN)
        end = problem.duration if run.status == Status.DONE else run.time
        plain = replace(problem, duration=end, output_step=end, samples=0, sections=0)
        rows = companions.dense(TIGHTEST)[: companions.compared]
        index = companions.instants.index
        wanted = [index.searchsorted(companions.instants.last * k // BUNDLE) for k in range(BUNDLE)]
        self.begins = companions.instants.time[wanted]
        ends = np.minimum([*self.begins[1:], end], end)
        self.bundle.number_like(companions.bundle, RUN, problem.scene)
        problems = [
            replace(plain, start=LaneStart.at_row(rows[i], kernel.row), duration=float(stop))
            for i, stop in zip(wanted, ends, strict=True)
            if i < len(rows)
        ]
        self.bundle.load_together(dict(enumerate(problems)), like=0)

    @property
    def times(self) -> Floats:
        """Simulated time that each lane has reached, s."""
        return np.array([self.bundle.lane(lane).time for lane in range(BUNDLE)])

    def advance(self, budget: int) -> bool:
        """Make some attempts. Returns whether more are to be made."""
        aligning = math.ceil(ALIGNING * self.attempts)
        goal = aligning if self.bundle.attempts < aligning else self.attempts
        running = self._grow(min(budget, goal - self.bundle.attempts))
        while self.bundle.behind:  # a window is a number of attempts, of all lanes alike
            running = self._grow(self.bundle.behind)
        if self.bundle.attempts == aligning:
            still = self.bundle.runs["status"] == Status.RUNNING
            self.aligned = np.where(still, [self.times, self.logarithms], np.nan)
        return running > 0 and self.bundle.attempts < self.attempts

    def _grow(self, budget: int) -> int:
        running = self.bundle.advance(budget)
        for lane in range(BUNDLE):
            for grown in self.bundle.growth(lane)[:, 1]:  # one by one: a sum depends on slices
                self.grown[lane] += grown
        return running

    def checkpoint(self) -> dict[str, NDArray[Any]]:
        """Return arrays that `restore` takes."""
        return self.bundle.state("windows") | {
            "windows_growth": np.vstack([self.grown, self.aligned]),
            "windows_attempts": np.array(self.bundle.attempts),
        }

    def restore(self, saved: Mapping[str, NDArray[Any]]) -> None:
        """Continue from a checkpoint."""
        self.bundle.restore(saved, "windows")
        self.bundle.attempts = int(saved["windows_attempts"])
        self.grown, self.aligned = saved["windows_growth"][0], saved["windows_growth"][1:]

    @property
    def logarithms(self) -> Floats:
        """Logarithm of how much each tangent has grown."""
        lanes = [self.bundle.lane(lane) for lane in range(BUNDLE)]
        lengths = [measure_tangent(lane.slots, lane.work, lane.index) for lane in lanes]
        logarithms = [
            logarithm(length) if 0.0 < length < math.inf else length or -math.inf
            for length in lengths
        ]
        return np.asarray(self.grown + np.array(logarithms), np.float64)

    def exponent(self) -> Exponent | None:
        """Return what the windows say; none where there is no tangent, or no time to follow it."""
        status = self.bundle.runs["status"]
        sound = (status == Status.RUNNING) | (status == Status.DONE)
        spans, growth = [self.times, self.logarithms] - self.aligned
        # what ended soon behind its alignment, where the next window begins, tells no rate
        least = np.where(status == Status.DONE, self.aligned[0] - self.begins, 0.0)
        used = sound & (spans > least) & np.isfinite(growth)
        if not used.any():
            return None
        rates = growth[used] / spans[used]
        count = len(rates)
        return Exponent(
            float(growth[used].sum() / spans[used].sum()),
            float(rates.std(ddof=1) / math.sqrt(count)) if count > 1 else math.inf,
            float(rates.min()),
            float(rates.max()),
            count,
            float(spans[used].sum()),
        )
