"""Start values that a scene gives, as rows: positions and angles, and their rates.

Rows are in metres, and in m/s: an angle counts by the arc at the body's farthest point. The
distance of a start from what was given is the root of the sum of their squares.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.scene.document import Scene


class Rows(NamedTuple):
    """Equations and their Jacobian."""

    value: Floats
    """(rows,) m, or m/s."""
    jacobian: Floats
    """(rows, 3 bodies)."""

    @classmethod
    def joined(cls, parts: Sequence["Rows"], columns: int) -> "Rows":
        """Return the rows of all parts, which have so many columns."""
        if not parts:
            return cls(np.zeros(0), np.zeros((0, columns)))
        value, jacobian = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
        return cls(value, jacobian)


@dataclass(frozen=True)
class Given:
    """One thing that a scene gives of its start."""

    pointer: str
    """Where the scene has it, such as ``/start/angles/crank``."""
    unit: str
    wanted: tuple[float, ...]
    """In `unit`."""
    lever: float
    """Metres of a row in one of the unit: of an angle the arc of a radian."""
    measure: Callable[[Floats, Floats], tuple[Floats, Floats]]
    """Values (n,), in `unit`, at a pose and its rates, and their Jacobian (n, 3 bodies): by the
    pose, or of a rate by the rates."""
    coordinates: tuple[int, ...] = ()
    """Indices of a rate's values among all rates."""

    def rows(self, pose: Floats, velocity: Floats) -> Rows:
        """Return what it is off by, m or m/s."""
        value, jacobian = self.measure(pose, velocity)
        return Rows(self.lever * (value - np.array(self.wanted)), self.lever * jacobian)


class Taken(NamedTuple):
    """One value that a scene gives of its start, and the one that is taken."""

    pointer: str
    unit: str
    given: tuple[float, ...]
    taken: tuple[float, ...]
    off: float
    """Distance between both, m or m/s: of an angle that of the body's farthest point."""

    @property
    def sentence(self) -> str:
        """Both values in words, to as many digits as tell them apart."""
        given = taken = ""
        for digits in (6, 9, 12):
            if given == taken:
                given, taken = (_in_words(values, digits) for values in (self.given, self.taken))
        return f"The start has {taken} {self.unit} for {given} at {self.pointer}."


def _in_words(values: tuple[float, ...], digits: int) -> str:
    """Return values to some digits; what is rounding of metres is 0."""
    return ", ".join(f"{round(value, 12):z.{digits}g}" for value in values)


def levers(scene: Scene, least: float) -> dict[str, float]:
    """Return the distance of each body's farthest point from its centre of mass, m."""
    return {
        name: max([math.hypot(*point) for point in body.points.values()], default=0.0) or least
        for name, body in scene.bodies.items()
    }


def given_positions(mechanism: AbsoluteMechanism, length: float) -> list[Given]:
    """Return the angles and points that a scene gives, in its order.

    length : m, the lever of a body without points.
    """
    scene, lever = mechanism.scene, levers(mechanism.scene, length)
    angles = [
        Given(
            f"/start/angles/{body}",
            "rad",
            (angle,),
            lever[body],
            _angle(mechanism, body, 0),
        )
        for body, angle in scene.start.angles.items()
    ]
    points = [
        Given(f"/start/points/{name}", "m", tuple(position), 1.0, _point(mechanism, name))
        for name, position in scene.start.points.items()
    ]
    return [*angles, *points]


def given_rates(mechanism: AbsoluteMechanism, length: float) -> list[Given]:
    """Return the angular velocities and velocities that a scene gives, in its order."""
    scene, lever = mechanism.scene, levers(mechanism.scene, length)
    turning = [
        Given(
            f"/start/angular_velocities/{body}",
            "rad/s",
            (rate,),
            lever[body],
            _angle(mechanism, body, 1),
            (3 * mechanism.bodies.index(body) + 2,),
        )
        for body, rate in scene.start.angular_velocities.items()
    ]
    moving = [
        Given(
            f"/start/velocities/{body}",
            "m/s",
            tuple(rate),
            1.0,
            _centre(mechanism, body),
            (3 * mechanism.bodies.index(body), 3 * mechanism.bodies.index(body) + 1),
        )
        for body, rate in scene.start.velocities.items()
    ]
    return [*turning, *moving]


def without_rounding(given: list[Given], velocity: Floats, least: float) -> None:
    """Have rates, (3 bodies,), as given to the last bit where they differ by at most `least`, m/s.

    A run may depend on the last bit of how it is thrown.
    """
    for one in given:
        indices = list(one.coordinates)
        if np.abs(one.lever * (velocity[indices] - one.wanted)).max() <= least:
            velocity[indices] = one.wanted


def taken(given: list[Given], pose: Floats, velocity: Floats) -> Iterator[Taken]:
    """Yield what a pose and its rates make of what is given."""
    for one in given:
        values, _ = one.measure(pose, velocity)
        off = math.hypot(*one.rows(pose, velocity).value)
        yield Taken(one.pointer, one.unit, one.wanted, tuple(map(float, values)), off)


def distance(given: list[Given], pose: Floats, velocity: Floats) -> float:
    """Return how far a start is from all that was given, m or m/s."""
    return math.hypot(*(v for one in given for v in one.rows(pose, velocity).value))


def _angle(
    mechanism: AbsoluteMechanism, body: str, rate: int
) -> Callable[[Floats, Floats], tuple[Floats, Floats]]:
    k = 3 * mechanism.bodies.index(body) + 2

    def measure(pose: Floats, velocity: Floats) -> tuple[Floats, Floats]:
        jacobian = np.zeros((1, len(pose)))
        jacobian[0, k] = 1.0
        return (velocity if rate else pose)[[k]], jacobian

    return measure


def _centre(
    mechanism: AbsoluteMechanism, body: str
) -> Callable[[Floats, Floats], tuple[Floats, Floats]]:
    k = 3 * mechanism.bodies.index(body)

    def measure(pose: Floats, velocity: Floats) -> tuple[Floats, Floats]:
        return velocity[k : k + 2], np.eye(len(pose))[k : k + 2]

    return measure


def _point(
    mechanism: AbsoluteMechanism, name: str
) -> Callable[[Floats, Floats], tuple[Floats, Floats]]:
    def measure(pose: Floats, velocity: Floats) -> tuple[Floats, Floats]:
        marker = mechanism.marker(name, pose, velocity)
        jacobian, k, (x, y) = np.zeros((2, len(pose))), 3 * marker.body, marker.arm
        jacobian[:, k : k + 2] = np.eye(2)
        jacobian[:, k + 2] = -y, x
        return np.array(marker.position, np.float64), jacobian

    return measure
