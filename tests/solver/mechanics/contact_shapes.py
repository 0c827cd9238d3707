"""Shapes that touch, drawn by themselves: how far apart two bodies are, and where each is struck.

Nothing here is taken from the mechanics: circles, lines, and a curve whose nearest point is sought.
A shape gets the joint's points in the world (m), and the angles of its two bodies (rad).
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]
CORNERS = {"corner_1": (1, 1), "corner_2": (-1, 1), "corner_3": (-1, -1), "corner_4": (1, -1)}
WALLS = {"wall_1": 1, "wall_2": -1}


class Touch(NamedTuple):
    """Two surfaces where they are nearest: their distance, m, less than 0 in each other."""

    gap: float
    on_first: Array
    on_second: Array
    normal: Array
    """From the second body into the first, of length 1."""


Shape = Callable[[dict[str, Any], str, Array, float, Array, float], Touch]
"""From the joint, a part of it, the first point and angle, and the second's."""


def turned(vector: Any, angle: float) -> Array:
    """Return a vector turned by an angle, rad."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def journal(
    joint: dict[str, Any], _part: str, here: Array, _turn: float, there: Array, _other: float
) -> Touch:
    """Return where a circle inside of a circle is nearest to it."""
    radius, play = (joint["clearance"][name] for name in ("bearing_radius", "radial_clearance"))
    n = (there - here) / np.linalg.norm(there - here)
    wall, rim = here + radius * n, there + (radius - play) * n
    return Touch(float(n @ (wall - rim)), wall, rim, n)


def corner(
    joint: dict[str, Any], part: str, here: Array, turn: float, there: Array, other: float
) -> Touch:
    """Return the same of a slider's corner and its wall."""
    play, axis = joint["clearance"], math.atan2(*joint["axis"][::-1])
    along, side = CORNERS[part]
    beside = [along * play["length"] / 2.0, side * play["height"] / 2.0]
    struck = there + turned(beside, other + axis - joint["angle"])
    return _wall(play["height"] / 2.0 + play["wall_clearance"], side, turn + axis, here, struck)


def pin(
    joint: dict[str, Any], part: str, here: Array, turn: float, there: Array, _other: float
) -> Touch:
    """Return the same of a pin and a wall of its slot."""
    play, axis, side = joint["clearance"], math.atan2(*joint["axis"][::-1]), WALLS[part]
    struck = there + play["pin_radius"] * turned([0.0, side], turn + axis)
    return _wall(play["pin_radius"] + play["wall_clearance"], side, turn + axis, here, struck)


def _wall(away: float, side: int, axis: float, here: Array, struck: Array) -> Touch:
    n = turned([0.0, side], axis)
    gap = away - float(n @ (struck - here))
    return Touch(gap, struck + gap * n, struck, n)


def face(
    joint: dict[str, Any], _part: str, here: Array, turn: float, there: Array, other: float
) -> Touch:
    """Return the same of a round cam, its centre beside its shaft, and a flat face.

    The support function offset + amplitude sin α is that of a circle about (0, amplitude).
    """
    profile, lash = joint["profile"], joint["clearance"]["lash"]
    centre = here + turned([0.0, profile["amplitude"]], turn)
    u = turned(joint["normal"], other) / np.hypot(*joint["normal"])
    top = centre + (profile["offset"] - lash) * u
    gap = float(u @ (there - top))
    return Touch(gap, top, top + gap * u, -u)


def roller(
    joint: dict[str, Any], _part: str, here: Array, turn: float, there: Array, _other: float
) -> Touch:
    """Return the same of a roller and a cam, of which the path of the roller's centre is given."""
    offset, amplitude = (joint["profile"][name] for name in ("offset", "amplitude"))
    inside = turned(there - here, -turn)
    about = math.atan2(inside[1], inside[0])

    def path(a: float) -> tuple[Array, Array]:
        """Return a place of the path, and its derivative by the angle."""
        radius, slope = offset + amplitude * math.sin(a), amplitude * math.cos(a)
        away, aside = turned([1.0, 0.0], a), turned([0.0, 1.0], a)
        return radius * away, slope * away + radius * aside

    def slant(a: float) -> float:
        at, along = path(a)
        return float(along @ (inside - at))

    foot, along = path(brentq(slant, about - 0.3, about + 0.3, xtol=1e-15))
    outwards = np.array([along[1], -along[0]]) / np.hypot(*along)
    gap = float(outwards @ (inside - foot)) + joint["clearance"]["lash"]
    n = turned(-outwards, turn)
    rim = there + joint["roller_radius"] * n
    return Touch(gap, rim + gap * n, rim, n)
