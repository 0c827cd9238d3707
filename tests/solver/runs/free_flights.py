"""Scenes whose free flight is known in closed form: journals of bodies that only gravity moves."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Pair = tuple[float, float]

LAWS = {
    "contact": {"law": "lankarani-nikravesh", "stiffness": 1e9, "restitution": 0.9},
    "friction": {"law": "modified-coulomb", "coefficient": 0.1},
}


@dataclass(frozen=True)
class Flight:
    """A scene, and where the journal of its joint is until it first touches."""

    scene: dict[str, Any]
    clearance: float
    """m."""
    duration: float
    """s."""
    eccentricity: Callable[[Floats], Floats]
    """At times (n,): (2, n) m."""

    def gap(self, time: Floats) -> Floats:
        """Return the penetration at times (n,), m."""
        return np.hypot(*self.eccentricity(time)) - self.clearance

    def first_contact(self, looks: int) -> float:
        """Return when the gap first closes, s; infinite if it does not in so many looks."""
        time = np.linspace(0.0, self.duration, looks)
        closed = np.flatnonzero(self.gap(time) > 0.0)
        if not len(closed):
            return math.inf
        left, right = time[closed[0] - 1], time[closed[0]]
        for _ in range(60):
            middle = 0.5 * (left + right)
            left, right = (
                (left, middle) if self.gap(np.array([middle]))[0] > 0.0 else (middle, right)
            )
        return float(right)


def turned(angle: Any, point: Pair) -> Floats:
    """Return a body-fixed vector at an angle, or at many (n,): (2, n)."""
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.array([cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1]])


def flown(
    time: Floats, start: Floats, velocity: Pair, gravity: float, spin: float, point: Pair
) -> Floats:
    """Return the path (2, n) of a point of a body in free flight; gravity pulls down.

    start : of the point, m; point : from the centre of mass, where the body's angle is 0.
    """
    moved = turned(spin * time, point) - np.array(point)[:, None]
    path = start[:, None] + np.outer(velocity, time) + moved
    path[1] -= 0.5 * gravity * time**2
    return path


def rotor(
    clearance: float,
    centre: Pair,
    spin: float,
    velocity: Pair,
    eccentricity: Pair,
    gravity: float,
    duration: float,
) -> Flight:
    """Return an unbalanced rotor in one bearing on the ground.

    centre : of the journal, from the centre of mass, m; velocity : of the latter, m/s.
    """
    scene = {
        "name": "rotor",
        "gravity": [0.0, -gravity],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rotor": {"mass": 1.0, "inertia": 1e-4, "points": {"centre": list(centre)}}},
        "joints": {
            "J": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "rotor.centre",
                "clearance": {
                    "radial_clearance": clearance,
                    "bearing_radius": 20.0 * clearance,
                    **LAWS,
                },
            }
        },
        "start": {
            "angles": {"rotor": 0.0},
            "angular_velocities": {"rotor": spin},
            "velocities": {"rotor": list(velocity)},
            "joints": {"J": {"eccentricity": list(eccentricity)}},
        },
    }

    def path(time: Floats) -> Floats:
        return flown(time, np.array(eccentricity), velocity, gravity, spin, centre)

    return Flight(scene, clearance, duration, path)


def ring(
    clearance: float,
    radius: float,
    speed: float,
    slow: float,
    spin: float,
    velocity: Pair,
    eccentricity: Pair,
    gravity: float,
    duration: float,
) -> Flight:
    """Return a free ring about the pin of a crank, and a table that turns beside it.

    radius : of the crank, m; speed, slow : of the drivers of crank and table, rad/s.
    """
    pin = (0.0, radius)
    scene = {
        "name": "ring",
        "gravity": [0.0, -gravity],
        "ground": {"points": {"O": [0.0, 0.0], "T": [1.0, 0.0]}},
        "bodies": {
            "crank": {"mass": 0.3, "inertia": 1e-4, "points": {"O": [0, 0], "pin": list(pin)}},
            "ring": {"mass": 2.0, "inertia": 0.01, "points": {"eye": [0, 0]}},
            "table": {"mass": 1.0, "inertia": 0.01, "points": {"O": [0, 0], "tip": [0.2, 0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "E": {
                "type": "revolute",
                "bearing": "ring.eye",
                "journal": "crank.pin",
                "clearance": {
                    "radial_clearance": clearance,
                    "bearing_radius": 20.0 * clearance,
                    **LAWS,
                },
            },
            "T": {"type": "revolute", "bearing": "ground.T", "journal": "table.O"},
        },
        "drivers": {
            "motor": {"joint": "O", "speed": speed},
            "slow": {"joint": "T", "speed": slow},
        },
        "start": {
            "angles": {"ring": 0.0},
            "velocities": {"ring": list(velocity)},
            "angular_velocities": {"ring": spin},
            "joints": {"E": {"eccentricity": list(eccentricity)}},
        },
    }

    def path(time: Floats) -> Floats:
        eye = flown(time, np.array(pin) - eccentricity, velocity, gravity, spin, (0.0, 0.0))
        return turned(speed * time, pin) - eye

    return Flight(scene, clearance, duration, path)
