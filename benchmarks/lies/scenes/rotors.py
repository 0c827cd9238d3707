"""An unbalanced rotor in its bearing: it spins fast and has no driver."""

import math
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import bearing, rotor_in_bearing


def rotor(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a rotor on a vertical or a level shaft, anywhere inside its bearing."""
    clearance = draw.size(5e-5, 5e-3)
    spin = draw.size(30.0, 3000.0)
    heading, speed = draw.even(0.0, 6.283), draw.size(1e-3, 0.3)
    at, aside = draw.even(0.0, 6.283), draw.even(0.0, 0.3)
    gravity = draw.one_of(0.0, -9.81)
    body = {
        "mass": draw.size(0.1, 10.0),
        "inertia": draw.size(1e-5, 1e-2),
        "points": {"pin": [clearance * draw.even(0.05, 0.65), 0.0]},
    }
    position = [aside * clearance * math.cos(at), aside * clearance * math.sin(at)]
    start = {
        "angles": {"rotor": 0.0},
        "angular_velocities": {"rotor": spin},
        "velocities": {"rotor": [speed * math.cos(heading), speed * math.sin(heading)]},
        "joints": {"J": {"eccentricity": position}},
    }
    scene = rotor_in_bearing("rotor", gravity, body, bearing(draw, clearance), start)
    return scene, min(max(1e-2 * clearance / 1e-3, 10.0 / spin), 0.03)
