"""A companion: a neighbour of a run that takes exactly the run's steps, its own onsets located.

It shares the compiled equations with the run and nothing of what makes tangent vectors: no
derivative, no jump of a latched rate. Between the run's steps it has none of its own but those
that end on its onsets.
"""

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.target import own_target
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import aligned_zeros

LANES = own_target().lanes

Floats = NDArray[np.float64]

MOST_CORRECTIONS = 30
"""Steps of Newton's iteration for an onset; from so near, a few are enough."""


class Companion:
    """A neighbour of lane 0 of a bundle; all lanes of its own work array are alike."""

    def __init__(self, base: Bundle) -> None:
        self.base, self.kernel = base, base.kernel
        self.states, self.joints = self.kernel.states, len(self.kernel.pairs)
        self.work = aligned_zeros(self.kernel.layout.size, LANES)
        self.work[:] = base.groups[0].work[: len(self.work), [0]]
        for name in ("largest_step", "end", "next_due", "pace_at"):
            self._set(name, np.inf)
        self._set("active", 1.0)

    def _set(self, name: str, value: float) -> None:
        self.work[self.kernel.layout[name]] = value

    def _get(self, name: str) -> float:
        return float(self.work[self.kernel.layout[name], 0])

    def _put(self, name: str, values: Floats) -> None:
        self.work[self.kernel.layout.block(name)] = values[:, None]

    @property
    def state(self) -> Floats:
        """Coordinates and speeds."""
        return self.work[self.kernel.layout.block("y"), 0].copy()

    @property
    def impact_rates(self) -> Floats:
        """Latched impact rates, m/s."""
        return np.array([self._get(f"impact_rate{j}") for j in range(self.joints)])

    def is_like_base(self) -> bool:
        """Whether the same joints are in contact."""
        modes = self.base.lane(0)["mode"]
        return all(self._get(f"mode{j}") == mode for j, mode in enumerate(modes))

    def start(self, away: Floats, rates_away: Floats) -> None:
        """Stand beside the base: `away` in its state, `rates_away` in its latched rates."""
        base = self.base.lane(0)
        self._set("time", base.number("time"))
        state = base["y"] + away
        self._put("y", state)
        self._put("stage", state)
        self._set("stage_time", base.number("time"))
        self._put("mode", base["mode"])
        self._put("impact_rate", base["impact_rate"] + rates_away)
        self.kernel.module.right_hand_side(self.work)
        self._put("k1_", self.work[self.kernel.layout.block("slope"), 0].copy())

    def follow(self) -> bool:
        """Let the base attempt a step, and take it, too; whether it took one."""
        base = self.base
        before, steps = base.lane(0).number("time"), base.lane(0).number("steps")
        phases = base.lane(0)["phase"].copy()
        base.advance(1)
        if base.lane(0).number("steps") == steps:
            return False
        self._set("time", before)
        self._put("phase", phases)
        left = float(base.lane(0).number("before_step"))
        while left > 0.0:
            left -= self._part(left)
        return True

    def _part(self, span: float) -> float:
        """Step over a span, or to the first onset inside it; how far."""
        self._attempt(span)
        onsets = []
        for j in range(self.joints):
            if self._get(f"mode{j}") == 0.0 and self._get(f"penetration{j}") > 0.0:
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
        self._set(f"impact_rate{joint}", max(self._get(f"penetration_rate{joint}"), floor))
        return reached

    def _onset(self, j: int, span: float) -> float:
        reached = span
        for _ in range(MOST_CORRECTIONS):
            better = reached - self._get(f"penetration{j}") / self._get(f"penetration_rate{j}")
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
            opened = self._get(f"penetration{j}") <= 0.0 and self._get(f"penetration_rate{j}") < 0.0
            if self._get(f"mode{j}") > 0.0 and opened:
                self._set(f"mode{j}", 0.0)


def companion_growth(base: Bundle, distance: float, most: float) -> list[tuple[float, float]]:
    """Run a bundle's lane 0 with a companion; (end of time, logarithm of growth) of each period.

    The companion starts, and starts afresh after each period, in the direction of the tangent
    vector, `distance` away in the metric of the error weights; it is brought back to `distance`
    along its own direction when it is `most` times farther away.
    """
    companion = Companion(base)
    lane = base.lane(0)
    weights = lane["weight"].copy()

    def beside_tangent() -> None:
        companion.start(distance * lane["tangent"], distance * lane["tangent_impact_rate"])

    beside_tangent()
    grown, found = 0.0, []
    while lane.running:
        if not companion.follow():
            continue
        away = companion.state - lane["y"]
        length = float(np.linalg.norm(away * weights)) / distance
        if len(base.growth(0)):
            found.append((float(base.growth(0)[0, 0]), grown + np.log(length)))
            grown = 0.0
            beside_tangent()
        elif not 1.0 / most < length < most and companion.is_like_base():
            grown += np.log(length)
            rates = lane["impact_rate"].copy()
            companion.start(away / length, (companion.impact_rates - rates) / length)
    return found
