"""The path of a driven mechanism: poses along time, each followed from the one before.

A step is taken only if Newton's iteration starts near the pose and converges at once, and if the
constraints' Jacobian changes little: no eigenvalue of J_0⁺ J_1 - I is above 1/2. Where any loop's
own transmission changes its sign, it has one below -1, whatever the others do; so no loop flips,
and steps shrink towards a dead point, which they approach but do not pass (Allgower and Georg 1990,
ch. 6; Deuflhard 2011, sec. 5.1, for the test of the start).
"""

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.linear_algebra.elimination import solve_many
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.products import applied, product
from jointplay.solver.linear_algebra.spectral_radius import spectral_radius
from jointplay.solver.mechanics.closing import RANK_TOLERANCE
from jointplay.solver.quantities.scalars import power
from jointplay.solver.runs.ideal.constraints import Constraints, System, solve

FEWEST_A_SCALE = 24
"""Least number of steps in the mechanism's time scale; straight motion needs no more."""
NEAR = 0.1
"""Largest first correction of Newton's iteration, in rad and lengths of the shortest link."""
BETWEEN = 1e-3
"""Largest distance of a pose from the cubic between two points of the path, in the same."""
CONTRACTION = 0.25
"""Largest share of a correction that the next one may have."""
MOST_CHANGE = 0.5
"""Largest relative change of the Jacobian in a step."""
SQUARINGS = 6
"""Squarings of the relative change, for a bound of its eigenvalues that is near them."""
AIM, AIM_OFF = 0.3, 0.01
"""Change, and first correction, that the next step is chosen for."""
LEAST_STEP = 1e-12
"""Step, in time scales, at which a path is at its end."""
MOST_CORRECTIONS = 12
ENOUGH, ROUNDING = 1e-13, 1e-9
"""Corrections below the first are rounding; so are those below the other that shrink no more."""
CONSISTENT = 1e-8
"""Rates at which redundant constraints are violated, as a share of the largest, or residuals in
lengths, that are rounding."""


class Lost(Exception):
    """A pose that the path does not reach, at a time in s."""

    def __init__(self, time: float) -> None:
        self.time = time
        super().__init__(f"The path does not reach t = {time:.6g} s.")


@dataclass(frozen=True)
class Point:
    """A pose on the path, with what the next step needs."""

    time: float
    pose: Floats
    velocity: Floats
    acceleration: Floats
    system: System
    inverse: Floats
    """(3 bodies, rows) inverse of the Jacobian, without units."""
    consistent: bool
    """Whether redundant constraints agree in their rates."""


class Path:
    """Poses of a driven mechanism from its start on; `scale` s is its scale of time."""

    def __init__(self, constraints: Constraints, start: Floats, scale: float) -> None:
        self.constraints = constraints
        self.scale = scale
        self.end = self._point(start, 0.0)
        self.times, self._poses, self._rates = [0.0], [start], [self.end.velocity]
        self._step = scale / FEWEST_A_SCALE
        self._tables: tuple[Floats, Floats, Floats] | None = None

    @property
    def turned(self) -> Floats:
        """Return how far each coordinate has come from its start, (3 bodies,) m, rad."""
        return np.asarray(self.end.pose - self._poses[0], np.float64)

    def follow(self, until: float, most: float = np.inf) -> bool:
        """Go on to a time in s, over at most so many poses. Returns whether it came there."""
        self._tables = None
        largest = self.scale / FEWEST_A_SCALE
        while self.end.time < until and self.end.consistent and len(self.times) < most:
            left = until - self.end.time
            step = min(self._step, largest, left)
            if step < left < 2.0 * step:
                step = 0.5 * left
            time = until if step == left else self.end.time + step
            found, growth = self._reached(self.end, time)
            if found is not None:
                self.end = found
                self.times.append(found.time)
                self._poses.append(found.pose)
                self._rates.append(found.velocity)
                self._step = step * min(max(growth, 0.5), 2.0)
                continue
            self._step = step * min(max(growth, 0.25), 0.5)
            if self._step < LEAST_STEP * self.scale:
                return False
        return self.end.time >= until

    def poses(self, times: Floats) -> Floats:
        """Return poses (times, 3 bodies), each from the cubic between the two points around it.

        Where that is not near enough, steps are taken from the point before.

        Raises
        ------
        Lost
            At a time that the path does not reach.
        """
        if self._tables is None:
            self._tables = np.array(self.times), np.array(self._poses), np.array(self._rates)
        at, poses, rates = self._tables
        before = np.clip(np.searchsorted(at, times, side="right") - 1, 0, max(len(at) - 2, 0))
        after = np.minimum(before + 1, len(at) - 1)
        length = np.where(after > before, at[after] - at[before], 1.0)[:, None]
        share = (times - at[before])[:, None] / length
        left = 1.0 - share
        guess = (
            left * left * (1.0 + 2.0 * share) * poses[before]
            + share * share * (3.0 - 2.0 * share) * poses[after]
            + share * left * length * (left * rates[before] - share * rates[after])
        )
        try:
            found, sound, _ = self.closed(guess, times)
            off = np.abs((found - guess) / self.constraints.scale).max(axis=1)
            sound &= off <= BETWEEN
        except np.linalg.LinAlgError:
            found, sound = guess, np.full(len(times), False)
        for k in np.flatnonzero(~sound):
            found[k] = self._aside(int(before[k]), float(times[k]))
        return found

    def _aside(self, before: int, time: float) -> Floats:
        """Return the pose at a time by steps of its own from the pose before it."""
        here = self._point(self._poses[before], self.times[before])
        step, least = time - here.time, LEAST_STEP * self.scale
        while time - here.time > least:
            step = min(step, time - here.time)
            there, _ = self._reached(here, time if step == time - here.time else here.time + step)
            if there is not None:
                here = there
            else:
                step *= 0.5
            if step < least:
                raise Lost(time)
        return here.pose

    def _reached(self, here: Point, time: float) -> tuple[Point | None, float]:
        """Return the point at a time, if a step leads there, and how much longer one may be."""
        h = time - here.time
        guess = here.pose + h * (here.velocity + 0.5 * h * here.acceleration)
        try:
            pose, is_sound, system = self.closed(guess, time)
            if not is_sound:
                return None, 0.0
            there = self._point(pose, time, system)
        except np.linalg.LinAlgError:
            return None, 0.0
        change = _change(here, there)
        off = float(np.abs((pose - guess) / self.constraints.scale).max())
        if not math.isfinite(change):
            return None, 0.0
        growth = min(AIM / max(change, 1e-3), power(AIM_OFF / max(off, 1e-9), 1.0 / 3.0))
        return (there if change <= MOST_CHANGE else None), growth

    def closed(self, guess: Floats, time: float | Floats) -> tuple[Floats, Flags, System]:
        """Return the poses (..., 3 bodies) beside guesses, and to which Newton went at once.

        Each is found as if it were alone. The rows are those before the last correction, which is
        rounding.
        """
        constraints, q, still = self.constraints, guess, np.zeros_like(guess)
        driven = constraints.driven(time)
        most = np.full(q.shape[:-1], NEAR)
        going, sound = np.full(most.shape, True), np.full(most.shape, True)
        for _ in range(MOST_CORRECTIONS):
            found = constraints.system(q, still, driven)
            step = -solve(found.jacobian, found.value, free=constraints.free)
            size = np.abs(step).max(axis=-1)
            stays = going & ~(size <= most)
            sound = sound & ~(stays & ~(size < ROUNDING))
            going = going & ~stays
            q = np.where(going[..., None], q + step * constraints.scale, q)
            going = going & (size > ENOUGH)
            if not going.any():
                break
            most = np.maximum(CONTRACTION * size, ENOUGH)
        left = np.abs(found.value).max(axis=-1, initial=0.0)
        return q, sound & ~going & (left <= CONSISTENT), found

    def _point(self, pose: Floats, time: float, system: System | None = None) -> Point:
        """Return a pose with what the next step needs; `system` if its rows are known."""
        constraints = self.constraints
        driven = constraints.driven(time)
        if system is None:
            system = constraints.system(pose, np.zeros_like(pose), driven)
        jacobian = system.jacobian
        if jacobian.shape[0] == jacobian.shape[1] and not constraints.free:
            inverse = solve_many(jacobian, np.eye(len(jacobian)))
        else:
            tolerance = RANK_TOLERANCE if constraints.free else 0.0
            inverse = Decomposition(jacobian, tolerance).inverse()
        velocity = -applied(inverse, system.rate)
        left = np.abs(system.rate + applied(jacobian, velocity)).max(initial=0.0)
        consistent = bool(left <= CONSISTENT * np.abs(system.rate).max(initial=0.0))
        velocity = velocity * constraints.scale
        moving = constraints.system(pose, velocity, driven)
        acceleration = applied(inverse, moving.gamma) * constraints.scale
        return Point(time, pose, velocity, acceleration, system, inverse, consistent)


def _change(here: Point, there: Point) -> float:
    """Return a bound of the eigenvalues of J_0⁺ J_1 - I; those of columns of J that stay are 0."""
    moved = there.system.jacobian - here.system.jacobian
    columns = np.flatnonzero(np.abs(moved).max(axis=0, initial=0.0))
    return spectral_radius(product(here.inverse[columns], moved[:, columns]), SQUARINGS)
