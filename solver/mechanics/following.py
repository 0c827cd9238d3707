"""Following the ideal mechanism: its poses as the drivers go on, and where they cannot.

Each pose is found by Newton's iteration from the one before, in steps that are halved where bodies
would turn far: the mechanism stays in the assembly that it is run in. What no driver moves is
carried along, as little as the joints need.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import LimitExceeded, SimulationFailed
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble, shortest_link
from jointplay.solver.mechanics.closing import arrays, close
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.periods import quickest_driver

STEPS_A_TURN = 32
"""Steps of the quickest driver's turn, or bend, at least."""
MOST_STEPS = 8192
LARGEST_TURN = 0.3
"""Largest turn of a body in one step, rad."""
MOST_HALVED = 4096.0
"""Part of the first step below which the mechanism is lost."""
ITERATIONS, CONVERGED = 25, 1e-7
"""Steps of Newton's iteration, and the last one, which leaves an error of its square."""
SINGULAR = -20.7
"""Logarithm of the share of its determinant at the start that a constraint Jacobian keeps at a
dead point, or less: 1e-9."""


@dataclass(frozen=True)
class Followed:
    """Poses of an ideal mechanism at instants, up to where it is lost."""

    poses: Floats
    """(instants that are reached, 3 bodies) x, y (m) and theta (rad), whole turns counted."""
    lost: SimulationFailed | None
    """Where drivers cannot go on: at a dead point, or where the links do not reach."""


def follow(scene: Scene, times: Sequence[float]) -> Followed:
    """Return the poses of a scene, its clearances closed, at instants.

    times : s, from 0 on, none before the one before it.

    Raises
    ------
    LimitExceeded
        The last instant is too many turns of a driver away.
    """
    quickest = quickest_driver(scene)
    if times and times[-1] * STEPS_A_TURN > MOST_STEPS * quickest:
        raise LimitExceeded.at(
            "/times",
            f"{MOST_STEPS // STEPS_A_TURN} turns of the quickest driver are followed, to"
            f" {MOST_STEPS / STEPS_A_TURN * quickest:.3g} s; give earlier times.",
        )
    following = _Following(scene, quickest / STEPS_A_TURN)
    poses = []
    for instant in times:
        if not following.reaches(instant):
            break
        poses.append(following.pose)
    return Followed(np.array(poses).reshape(len(poses), len(following.pose)), following.lost)


class _Following:
    """A mechanism on its way: `pose` at `time`, and `lost` once it cannot go on."""

    def __init__(self, scene: Scene, longest: float) -> None:
        self.mechanism = AbsoluteMechanism(scene, view(scene), close_play=True)
        self.clocks = clocks(scene)
        assembly = assemble(scene)
        self.length = shortest_link(scene)
        self.scale = np.tile([self.length, self.length, 1.0], len(scene.bodies))
        self.still = np.zeros(len(self.scale))
        self.pose, self.time, self.longest = assembly.pose, 0.0, longest
        self.is_square = assembly.rank == assembly.constraints == len(self.pose)
        self.orientation = self._orientation(self._rows(self.pose, 0.0)[1])
        self.lost: SimulationFailed | None = None
        if assembly.residual > ASSEMBLED * self.length:
            miss = f"The joints do not close at t = 0: {assembly.residual:.3g} (m or rad) remain."
            self.lost = SimulationFailed("assembly-lost", miss, 0.0)

    def reaches(self, instant: float) -> bool:
        """Go on to an instant; whether the mechanism gets there."""
        if math.isinf(self.longest):  # nothing is driven
            self.time = instant
        step = first = min(self.longest, instant - self.time)
        while self.time < instant and self.lost is None:
            step = min(step, instant - self.time)
            then = min(instant, self.time + step)
            found = self._next(then)
            if found is not None:
                self.pose, self.time = found, then
                step = min(2.0 * step, self.longest)
            elif step * MOST_HALVED > first:
                step *= 0.5
            else:
                self.lost = SimulationFailed("assembly-lost", self._reason(then), self.time)
        return self.time >= instant

    def _reason(self, then: float) -> str:
        """Return why the drivers do not go on to an instant."""
        for name, driver in self.mechanism.scene.drivers.items():
            domain = driver.motion.domain if isinstance(driver, MovingDriver) else None
            if domain is not None and then > domain[1]:
                return f"The motion of driver '{name}' is given up to t = {domain[1]:.4g} s."
        return (
            f"The drivers cannot go on past t = {self.time:.4g} s: a dead point is there, or the"
            " links do not reach."
        )

    def _next(self, then: float) -> Floats | None:
        """Return the pose at an instant, None if it is far from this one or on its other side."""
        pose, driven = self.pose.copy(), self._driven(then)
        close(self.mechanism, pose, driven, self.scale, None, ITERATIONS, CONVERGED)
        residual, jacobian = self._rows(pose, then)
        if not np.abs(residual).max(initial=0.0) <= ASSEMBLED * max(1.0, self.length):
            return None
        if np.abs(pose - self.pose)[2::3].max() > LARGEST_TURN:
            return None
        sign, logarithm = self._orientation(jacobian)
        if sign != self.orientation[0] or logarithm < self.orientation[1] + SINGULAR:
            return None
        return pose

    def _rows(self, pose: Floats, then: float) -> tuple[Floats, Floats]:
        rows = self.mechanism.rows(pose, self.still, self._driven(then))
        return arrays(rows, len(pose))

    def _driven(self, then: float) -> dict[str, float]:
        return {name: clock.start + clock.rate * then for name, clock in self.clocks.items()}

    def _orientation(self, jacobian: Floats) -> tuple[float, float]:
        """Return sign and logarithm of a determinant, which passes zero at a dead point."""
        if not self.is_square:
            return 1.0, 0.0
        sign, logarithm = np.linalg.slogdet(jacobian * self.scale)
        return float(sign), float(logarithm)
