"""Motion of an ideal mechanism: kinematics and inverse dynamics at many instants at once.

The same constraint rows as everywhere, on arrays of instants. Poses are found from those of the
path beside them; the mechanism repeats after a period, if it has one.
"""

import math
from collections.abc import Mapping

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kernels.compensated import product_difference
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.motion import Motion, body_motions, forces_between
from jointplay.solver.runs.ideal.constraints import Constraints, solve, solve_transposed
from jointplay.solver.runs.ideal.dead_point import elsewhere, lost_at
from jointplay.solver.runs.ideal.path import Lost, Path
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import forces_repeat
from jointplay.solver.scene.time_scales import characteristic_time, quickest_driver

COMES_BACK = 1e-6
"""Distance of poses a period apart, in rad and lengths of the shortest link, that is rounding."""
MOST_PERIODS = 4
"""Periods of the drivers within which a mechanism may come back."""
INSTANTS_A_BEND = 25
"""Instants in the shortest time in which a driver or a force turns or bends."""


class IdealMotion:
    """A scene whose drivers leave no freedom, over `duration` s; `period` s, if they have one.

    After it, or after a few of them, the mechanism repeats, unless gears turn bodies by other than
    whole turns. `lost` is how the motion ends early: at a dead point, or where the links do not
    reach.
    """

    def __init__(self, scene: Scene, period: float | None, duration: float) -> None:
        self.scene = scene
        self.period = None if scene.gears else period
        """s, after which the mechanism repeats."""
        self.periods = 1
        """Periods of the drivers in that time."""
        self.constraints = Constraints(scene)
        self.numbers, self.mechanism = self.constraints.numbers, self.constraints.mechanism
        self.unit = period or characteristic_time(scene, self.constraints.length)
        self._bend = float(characteristic_time(scene, self.constraints.length))
        span = min(duration, self.unit) if self.period else duration
        scale = min(quickest_driver(scene, self.constraints.length), span)
        self.path = Path(self.constraints, assemble(scene).pose, scale)
        self.lost = self._followed(duration)

    def _followed(self, duration: float) -> SimulationFailed | None:
        """Follow the path until the mechanism repeats. Returns how it is lost before, if it is."""
        period = self.period
        if period is None:
            return None if self.path.follow(duration) else lost_at(self.path, self.scene)
        for count in range(1, MOST_PERIODS + 1):
            self.period, self.periods = count * period, count
            if not self.path.follow(min(self.period, duration)):
                return lost_at(self.path, self.scene)
            if self.period > duration or self._comes_back():
                return None
        self.period, end = None, self.path.end.time
        return elsewhere(MOST_PERIODS, end) if end < duration else None

    def instants(self, span: float, a_period: int) -> int:
        """Return at how many instants of a span, s, extremes are first sought.

        So many in a period, and `INSTANTS_A_BEND` in the shortest time in which a driver or a force
        turns or bends.
        """
        return math.ceil(max(a_period * span / self.unit, INSTANTS_A_BEND * span / self._bend))

    @property
    def forces_period(self) -> float | None:
        """s, after which forces repeat, too, or grow as before, as those of torsion springs do."""
        turns = np.rint(self.path.turned[2::3] / (2.0 * math.pi))
        return self.period if forces_repeat(self.scene) or not turns.any() else None

    def at(self, times: Floats, local: Floats) -> Motion:
        """Return the motion and all forces at times in s, `local` within the period.

        Raises
        ------
        SimulationFailed
            At a dead point.
        """
        driven = self.constraints.driven(local)
        q, turned = self._poses(times, local)
        system = self.constraints.system(q, np.zeros_like(q), driven)
        scale, jacobian = self.constraints.scale, system.jacobian
        v = -solve(jacobian, system.rate) * scale
        system = self.constraints.system(q, v, driven)
        a = solve(jacobian, system.gamma) * scale
        at = _columns(q), _columns(v)
        wound = _columns(turned)
        acting = forces_between(
            self.numbers, lambda *points: self.mechanism.ends(points, *at, wound), driven
        )
        applied = _columns(self._inertia_and_gravity(a))
        self.mechanism.apply(acting, applied, *at)
        force = np.stack(applied, axis=1) * scale
        multipliers = solve_transposed(jacobian, force) / self.constraints.units(system.rows)
        shown = q.copy()
        shown[:, 2::3] += turned[:, 2::3]
        bodies = body_motions(self.mechanism.bodies, *map(_columns, (shown, v, a)))
        forces, held, efforts = self.mechanism.reactions(system.rows, _columns(multipliers))
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

    def displacements(self, play: Mapping[str, Mapping[str, float]], times: Floats) -> Floats:
        """Return (times, 3 bodies) m, rad: how far play lets bodies leave their poses.

        To first order, with every constraint that play loosens as far off as it lets it, in the
        worst direction; `play` : m or rad by joint and by part of its constraint.
        """
        poses = self.path.poses(times)
        driven = self.constraints.driven(times)
        system = self.constraints.system(poses, np.zeros_like(poses), driven)
        found = np.zeros_like(poses)
        for i, row in enumerate(system.rows):
            gap = play.get(row.joint, {}).get(row.part, 0.0)
            if gap:
                unit = np.zeros(system.value.shape)
                unit[:, i] = gap / self.constraints.units([row])[0]
                found += np.abs(solve(system.jacobian, unit)) * self.constraints.scale
        return found

    def local(self, count: Floats, step: float | Floats) -> Floats:
        """Return count * step less whole periods, with the rounding of both products undone."""
        times = count * step
        if self.period is None:
            return times
        whole = np.floor(times / self.period)
        local = product_difference(count, step, whole, self.period)
        return np.asarray(local, np.float64)

    def _poses(self, times: Floats, local: Floats) -> tuple[Floats, Floats]:
        """Return poses within a period, and the whole turns that angles have made before."""
        if self.lost is not None and (times > self.lost.time).any():
            raise self.lost
        try:
            poses = self.path.poses(local)
        except Lost as lost:
            raise lost_at(self.path, self.scene, lost.time) from None
        turned = np.zeros_like(poses)
        if self.period is not None:  # angles go on turning; trigonometry does not need to know
            turns = np.rint(self.path.turned / (2.0 * math.pi))
            turned = 2.0 * math.pi * np.rint((times - local) / self.period)[:, None] * turns
        return poses, turned

    def _comes_back(self) -> bool:
        """Return whether the mechanism is as it began: a period may end in another assembly."""
        apart = self.path.turned / self.constraints.scale
        apart[2::3] = np.remainder(apart[2::3] + math.pi, 2.0 * math.pi) - math.pi
        return float(np.abs(apart).max()) <= COMES_BACK


def _columns(array: Floats) -> list[Floats]:
    return [array[:, i] for i in range(array.shape[1])]
