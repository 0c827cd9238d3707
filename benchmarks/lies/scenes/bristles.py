"""A journal that spins and bounces in its bearing, rubbed by bristles."""

import math
from collections.abc import Callable
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import rotor_in_bearing
from benchmarks.lies.scenes.surfaces import dahl, lugre


def of_lugre(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return it with bristles that are damped."""
    return _journal(draw, lugre)


def of_dahl(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return it with bristles that are not."""
    return _journal(draw, dahl)


def _journal(
    draw: Draw, friction: Callable[[Draw], dict[str, Any]]
) -> tuple[dict[str, Any], float]:
    clearance, mass = draw.size(2e-5, 1e-3), draw.size(0.02, 5.0)
    radius = clearance * draw.size(5.0, 200.0)
    at, aside = draw.even(0.0, 2.0 * math.pi), clearance * draw.even(0.0, 0.95)
    heading, speed = draw.even(0.0, 2.0 * math.pi), draw.size(5e-3, 0.5)
    gravity = draw.one_of(-9.81, 0.0)
    rotor = {
        "mass": mass,
        "inertia": mass * radius**2 * draw.size(0.5, 20.0),
        "points": {"pin": [radius * draw.even(0.0, 0.5), 0.0]},
    }
    fit = {
        "radial_clearance": clearance,
        "bearing_radius": radius,
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": draw.size(1e8, 1e11),
            "restitution": draw.even(0.2, 1.0),
        },
        "friction": friction(draw),
    }
    joint = {
        "eccentricity": [aside * math.cos(at), aside * math.sin(at)],
        "rate": [speed * math.cos(heading), speed * math.sin(heading)],
    }
    start = {"angular_velocities": {"rotor": draw.even(-300.0, 300.0)}, "joints": {"J": joint}}
    return rotor_in_bearing("bristled-journal", gravity, rotor, fit, start), clearance / speed
