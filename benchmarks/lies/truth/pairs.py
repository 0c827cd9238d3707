"""Pairs of surfaces of a joint with play that may touch, from its document."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

CORNERS = ((1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0))
"""Corners of a slider, along its axis and to the left of it, in the order of its pairs."""

CIRCLE, WALL, CAM = range(3)
"""Kinds of surfaces: a bearing, a straight wall, a cam under a flat face."""


class Pair(NamedTuple):
    """Two surfaces that may touch.

    Attributes
    ----------
    name : owner of its channels
    first, second : points of bearing or guide, and of journal, slider or pin
    arm : of a slider's corner from its point, in its axes, m
    wall, cam : as in `Mechanism`
    """

    name: str
    first: str
    second: str
    arm: tuple[float, float] = (0.0, 0.0)
    wall: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, CIRCLE)
    cam: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)


def pairs_of(name: str, joint: Mapping[str, Any]) -> list[Pair]:
    """Return the pairs of a joint with play."""
    if joint["type"] == "revolute":
        return [Pair(name, joint["bearing"], joint["journal"])]
    if joint["type"] == "flat-follower":
        (nx, ny), profile = joint["normal"], joint["profile"]
        wave = tuple(profile[name] for name in ("offset", "amplitude", "frequency", "phase"))
        long = math.hypot(nx, ny)
        wall = (-nx / long, -ny / long, 0.0, 0.0, CAM)
        return [Pair(name, joint["cam"], joint["follower"], wall=wall, cam=wave)]
    long = math.hypot(*joint["axis"])
    ux, uy = joint["axis"][0] / long, joint["axis"][1] / long
    fit = joint["clearance"]
    if joint["type"] == "pin-in-slot":
        radius = fit["pin_radius"]
        return [
            Pair(
                f"{name}.wall_{number}",
                joint["slot"],
                joint["pin"],
                wall=(-side * uy, side * ux, 0.0, radius, WALL),
            )
            for number, side in ((1, 1.0), (2, -1.0))
        ]
    # the slider's axes are turned by `angle` against the guide's
    cosine, sine = math.cos(joint["angle"]), math.sin(joint["angle"])
    ax, ay = cosine * ux + sine * uy, cosine * uy - sine * ux
    length, height = 0.5 * fit["length"], 0.5 * fit["height"]
    return [
        Pair(
            f"{name}.corner_{number}",
            joint["guide"],
            joint["slider"],
            (along * length * ax - side * height * ay, along * length * ay + side * height * ax),
            (-side * uy, side * ux, height, 0.0, WALL),
        )
        for number, (along, side) in enumerate(CORNERS, start=1)
    ]
