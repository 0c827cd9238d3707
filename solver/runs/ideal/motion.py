"""Motion of an ideal mechanism: kinematics and inverse dynamics at many instants at once.

The same constraint rows as everywhere, on arrays of instants. Newton's iteration starts from a
neighbouring instant; the mechanism repeats after a period, if it has one.
"""

import math
from collections.abc import Mapping

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kernels.compensated import product_difference
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble, shortest_link
from jointplay.solver.mechanics.motion import Motion, body_motions, forces_between
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import characteristic_time

INSTANTS_A_PERIOD = 96
"""Poses solved one after the other; all others start from the nearest of them."""
MOST_ITERATIONS = 25
SINGULAR = -20.7
"""Logarithm of the share of its determinant at the start that a constraint Jacobian keeps at a
dead point, or less: 1e-9."""


class IdealMotion:
    """A scene whose drivers leave no freedom, over `duration` s; `period` s, if they have one.

    After it the mechanism repeats, unless gears turn bodies by other than whole turns.
    `lost` is how the motion ends early: at a dead point, or where the links do not reach.
    """

    def __init__(self, scene: Scene, period: float | None, duration: float) -> None:
        self.scene = scene
        self.period = None if scene.gears else period
        self.numbers = view(scene)
        self.mechanism = AbsoluteMechanism(scene, self.numbers, close_play=True)
        self.length = shortest_link(scene)
        self.unit = period or characteristic_time(scene, self.length)
        self.lost: SimulationFailed | None = None
        self.start = assemble(scene).pose
        self.orientation = self._determinant(self.start[None, :])
        self.table = self._follow(min(duration, self.unit) if self.period else duration)

    def at(self, times: Floats, local: Floats) -> Motion:
        """Return the motion and all forces at times in s, `local` within the period.

        Raises
        ------
        SimulationFailed
            At a dead point.
        """
        driven = self._driven(local)
        q, turned = self._poses(times, local, driven)
        n = q.shape[1]
        still = np.zeros_like(q)
        rows = self.mechanism.rows(_columns(q), _columns(still), driven)
        jacobian = _jacobian(rows, len(times), n)
        self._check(q, times)
        rates = np.stack([np.broadcast_to(row.rate, times.shape) for row in rows], axis=1)
        v = _solve(jacobian, -rates)
        rows = self.mechanism.rows(_columns(q), _columns(v), driven)
        gamma = np.stack([np.broadcast_to(row.gamma, times.shape) for row in rows], axis=1)
        a = _solve(jacobian, gamma)
        at = _columns(q), _columns(v)
        wound = _columns(turned)
        acting = forces_between(
            self.numbers, lambda *points: self.mechanism.ends(points, *at, wound), driven
        )
        applied = _columns(self._inertia_and_gravity(a))
        self.mechanism.apply(acting, applied, *at)
        force = np.stack(applied, axis=1)
        multipliers = _solve(jacobian.transpose(0, 2, 1), force)
        shown = q.copy()
        shown[:, 2::3] += turned[:, 2::3]
        bodies = body_motions(self.mechanism.bodies, *map(_columns, (shown, v, a)))
        forces, held, efforts = self.mechanism.reactions(rows, _columns(multipliers))
        drivers = self.numbers.drivers.items()
        speeds = {name: driver.at(driven[name]).slope for name, driver in drivers}
        return Motion(list(_columns(a)), bodies, acting, forces, held, efforts, speeds)

    def _inertia_and_gravity(self, accelerations: Floats) -> Floats:
        """Return g - M q̈ of eq. (23), which the multipliers balance."""
        gx, gy = self.numbers.gravity
        force = np.empty_like(accelerations)
        for i, name in enumerate(self.mechanism.bodies):
            body = self.numbers.bodies[name]
            force[:, 3 * i] = body.mass * (gx - accelerations[:, 3 * i])
            force[:, 3 * i + 1] = body.mass * (gy - accelerations[:, 3 * i + 1])
            force[:, 3 * i + 2] = -body.inertia * accelerations[:, 3 * i + 2]
        return force

    def displacements(self, play: Mapping[str, Mapping[str, float]]) -> Floats:
        """Return (poses of `table`, 3 bodies) m, rad: how far play lets bodies leave their poses.

        To first order, with every constraint that play loosens as far off as it lets it, in the
        worst direction; `play` : m or rad by joint and by part of its constraint.
        """
        count, n = self.table.shape
        still = np.zeros_like(self.table)
        driven = self._driven(np.zeros(count))  # Jacobians do not depend on it
        rows = self.mechanism.rows(_columns(self.table), _columns(still), driven)
        gaps = np.zeros((count, len(rows), len(rows)))
        for i, row in enumerate(rows):
            gaps[:, i, i] = play.get(row.joint, {}).get(row.part, 0.0)
        displaced = np.linalg.solve(_jacobian(rows, count, n), gaps)
        return np.asarray(np.abs(displaced).sum(axis=2), np.float64)

    def local(self, count: Floats, step: float | Floats) -> Floats:
        """Return count * step less whole periods, with the rounding of both products undone."""
        times = count * step
        if self.period is None:
            return times
        whole = np.floor(times / self.period)
        local = product_difference(count, step, whole, self.period)
        return np.asarray(local, np.float64)

    def _driven(self, local: Floats) -> dict[str, Floats]:
        return {
            name: clock.start + clock.rate * local for name, clock in clocks(self.scene).items()
        }

    def _poses(
        self, times: Floats, local: Floats, driven: dict[str, Floats]
    ) -> tuple[Floats, Floats]:
        """Return poses within a period, and the whole turns that angles have made before."""
        spacing = self.unit / INSTANTS_A_PERIOD
        nearest = np.clip(np.rint(local / spacing).astype(int), 0, len(self.table) - 1)
        poses = self._newton(self.table[nearest], driven, times)
        turned = np.zeros_like(poses)
        if self.period is not None:  # angles go on turning; trigonometry does not need to know
            turns = np.rint((self.table[-1] - self.table[0]) / (2.0 * math.pi))
            turned = 2.0 * math.pi * np.rint((times - local) / self.period)[:, None] * turns
        return poses, turned

    def _follow(self, span: float) -> Floats:
        """Solve poses along the motion, each from the one before, up to where it is lost."""
        count = math.ceil(span / self.unit * INSTANTS_A_PERIOD) + 1
        poses = [self.start, self.start]
        for k in range(count):
            moment = np.array([k * self.unit / INSTANTS_A_PERIOD])
            guess = 2.0 * poses[-1] - poses[-2] if k > 1 else poses[-1]
            try:
                pose = self._newton(guess[None, :], self._driven(moment), moment)
                self._check(pose, moment)
            except SimulationFailed as lost:
                self.lost = lost
                break
            poses.append(pose[0])
        return np.array(poses[2:] or poses[:1])

    def _determinant(self, poses: Floats) -> tuple[Floats, Floats]:
        """Return sign and logarithm of the constraint Jacobian's determinant, rows of length 1."""
        still, driven = np.zeros_like(poses), self._driven(np.zeros(len(poses)))
        rows = self.mechanism.rows(_columns(poses), _columns(still), driven)
        jacobian = _jacobian(rows, *poses.shape)
        scaled = jacobian * np.tile([self.length, self.length, 1.0], poses.shape[1] // 3)
        sign, logarithm = np.linalg.slogdet(scaled)
        return np.asarray(sign), np.asarray(logarithm)

    def _check(self, poses: Floats, times: Floats) -> None:
        """Refuse poses at or beyond a dead point: there the determinant passes zero."""
        sign, logarithm = self._determinant(poses)
        beyond = (sign != self.orientation[0]) | (logarithm < self.orientation[1] + SINGULAR)
        if beyond.any():
            raise _lost(float(times[int(beyond.argmax())]))

    def _newton(self, guess: Floats, driven: dict[str, Floats], times: Floats) -> Floats:
        q = guess.copy()
        n = q.shape[1]
        still = np.zeros_like(q)
        scale = np.tile([self.length, self.length, 1.0], n // 3)
        for _ in range(MOST_ITERATIONS):
            rows = self.mechanism.rows(_columns(q), _columns(still), driven)
            values = np.stack([np.broadcast_to(row.value, times.shape) for row in rows], axis=1)
            try:
                step = _solve(_jacobian(rows, len(times), n), -values)
            except np.linalg.LinAlgError:
                raise _lost(float(times[0])) from None
            q += step
            largest = float(np.abs(step / scale).max())
            if not np.isfinite(largest) or largest < 1e-13:
                break
        if not largest < ASSEMBLED:
            raise _lost(float(times[int(np.abs(step / scale).max(axis=1).argmax())]))
        return q


def _columns(array: Floats) -> list[Floats]:
    return [array[:, i] for i in range(array.shape[1])]


def _jacobian(rows: list[Row], count: int, n: int) -> Floats:
    jacobian = np.zeros((count, len(rows), n))
    for i, row in enumerate(rows):
        for k, entry in row.jacobian.items():
            jacobian[:, i, k] = entry
    return jacobian


def _solve(matrix: Floats, right: Floats) -> Floats:
    solution = np.linalg.solve(matrix, right[..., None])[..., 0]
    return np.asarray(solution, np.float64)


def _lost(time: float) -> SimulationFailed:
    return SimulationFailed(
        "assembly-lost",
        f"The ideal mechanism cannot be followed past t = {time:.6g} s: it comes to a dead point,"
        " or its links do not reach. Change lengths, driver positions or speeds.",
        time,
    )
