"""A companion: a neighbour of a run that takes exactly the run's steps, its own onsets located.

It shares the compiled equations with the run and nothing of what makes tangent vectors: no
derivative, no jump of a latched rate. Between the run's steps it has none of its own but those
that end on its onsets.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.bundle import Bundle, aligned_zeros
from jointplay.solver.kernels.loop.state import Counter, Status

Floats = NDArray[np.float64]

MOST_CORRECTIONS = 30
"""Of Newton's iteration for an onset; from so near, a few are enough."""


class Companion:
    """A neighbour of lane 0 of a bundle; all lanes of its own work array are alike."""

    def __init__(self, base: Bundle) -> None:
        self.base, self.kernel = base, base.kernel
        self.states, self.joints = self.kernel.states, len(self.kernel.play)
        self.work = aligned_zeros(self.kernel.layout.size * LANES)
        self._lanes = self.work.reshape(-1, LANES)
        self._lanes[:] = base.work.reshape(-1, LANES)[: len(self._lanes), [0]]
        for name in ("largest_step", "end", "next_due", "pace_at"):
            self._set(name, np.inf)
        self._set("active", 1.0)

    def _set(self, name: str, value: float) -> None:
        self._lanes[self.kernel.layout[name]] = value

    def _get(self, name: str) -> float:
        return float(self._lanes[self.kernel.layout[name], 0])

    def _put(self, name: str, values: Floats) -> None:
        first = self.kernel.layout[f"{name}0"]
        self._lanes[first : first + len(values)] = values[:, None]

    @property
    def state(self) -> Floats:
        """Coordinates and speeds."""
        first = self.kernel.layout["y0"]
        return self._lanes[first : first + self.states, 0].copy()

    @property
    def impact_rates(self) -> Floats:
        """Latched impact rates, m/s."""
        return np.array([self._get(f"impact_rate{j}") for j in range(self.joints)])

    def is_like_base(self) -> bool:
        """Whether the same joints are in contact."""
        modes = self.base.table("mode0", self.joints)[:, 0] if self.joints else []
        return all(self._get(f"mode{j}") == mode for j, mode in enumerate(modes))

    def start(self, away: Floats, rates_away: Floats) -> None:
        """Stand beside the base: `away` in its state, `rates_away` in its latched rates."""
        table = self.base.table
        self._set("time", table("time")[0, 0])
        state = table("y0", self.states)[:, 0] + away
        self._put("y", state)
        self._put("stage", state)
        self._set("stage_time", table("time")[0, 0])
        if self.joints:
            self._put("mode", table("mode0", self.joints)[:, 0])
            self._put("impact_rate", table("impact_rate0", self.joints)[:, 0] + rates_away)
        self.kernel.module.right_hand_side(self.work)
        first = self.kernel.layout["slope0"]
        self._put("k1_", self._lanes[first : first + self.states, 0].copy())

    def follow(self) -> bool:
        """Let the base attempt a step, and take it, too; whether it took one."""
        base = self.base
        before, steps = base.table("time")[0, 0], base.table("steps")[0, 0]
        phases = [base.table(f"phase{k}")[0, 0] for k in range(len(self.kernel.drivers))]
        base.advance(1)
        if base.table("steps")[0, 0] == steps:
            return False
        self._set("time", before)
        for k, phase in enumerate(phases):
            self._set(f"phase{k}", phase)
        left = float(base.table("before_step")[0, 0])
        while left > 0.0:
            left -= self._part(left)
        return True

    def _part(self, span: float) -> float:
        """Step over a span, or to the first onset inside it; how far."""
        self._attempt(span)
        onsets = []
        for j in range(self.joints):
            if self._get(f"mode{j}") == 0.0 and self._get(f"gap{j}") > 0.0:
                onsets.append((self._onset(j, span), j))
                self._attempt(span)
        if not onsets:
            self._take()
            return span
        reached, joint = min(onsets)
        self._attempt(reached)
        self._take()
        floor = self._get(f"impact_floor{joint}")
        self._set(f"mode{joint}", 1.0)
        self._set(f"impact_rate{joint}", max(self._get(f"gap_rate{joint}"), floor))
        return reached

    def _onset(self, j: int, span: float) -> float:
        reached = span
        for _ in range(MOST_CORRECTIONS):
            better = reached - self._get(f"gap{j}") / self._get(f"gap_rate{j}")
            better = min(max(better, 0.0), span)
            if better == reached:
                break
            reached = better
            self._attempt(reached)
        return reached

    def _attempt(self, span: float) -> None:
        self._set("step", span)
        self.kernel.module.attempt(self.work)

    def _take(self) -> None:
        self._set("accept", 1.0)
        self.kernel.module.take(self.work)
        for j in range(self.joints):
            opened = self._get(f"gap{j}") <= 0.0 and self._get(f"gap_rate{j}") < 0.0
            if self._get(f"mode{j}") > 0.0 and opened:
                self._set(f"mode{j}", 0.0)


def companion_growth(base: Bundle, distance: float, most: float) -> list[tuple[float, float]]:
    """Run a bundle's lane 0 with a companion; (end of time, logarithm of growth) of each period.

    The companion starts, and starts afresh after each period, in the direction of the tangent
    vector, `distance` away in the metric of the error weights; it is brought back to `distance`
    along its own direction when it is `most` times farther away.
    """
    companion = Companion(base)
    table, states, joints = base.table, companion.states, companion.joints
    weights = table("weight0", states)[:, 0].copy()

    def beside_tangent() -> None:
        rates = table("tangent_impact_rate0", joints)[:, 0] if joints else np.zeros(0)
        companion.start(distance * table("tangent0", states)[:, 0], distance * rates)

    beside_tangent()
    grown, found = 0.0, []
    while base.counters[Counter.STATUS, 0] == Status.RUNNING:
        if not companion.follow():
            continue
        away = companion.state - table("y0", states)[:, 0]
        length = float(np.linalg.norm(away * weights)) / distance
        if base.counters[Counter.GROWTH_ROWS, 0]:
            found.append((float(base.growth_rows[0, 0, 0]), grown + np.log(length)))
            grown = 0.0
            beside_tangent()
        elif not 1.0 / most < length < most and companion.is_like_base():
            grown += np.log(length)
            rates = table("impact_rate0", joints)[:, 0].copy() if joints else np.zeros(0)
            companion.start(away / length, (companion.impact_rates - rates) / length)
    return found
