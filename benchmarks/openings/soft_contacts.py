"""A soft bearing that is rubbed weakly: its journal goes deep, and passes by the hole's edge.

So a contact lasts, and is interrupted by openings as short as one likes.
"""

import math
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import rotor_in_bearing

SWINGS = 8.0
"""Duration of a run, in durations of an impact (Hertz: 2.94 depth / speed)."""


def soft_contact(draw: Draw) -> dict[str, Any]:
    """Return the document of a job without accuracy."""
    mass, clearance = draw.size(0.01, 1.0), draw.size(1e-6, 5e-5)
    stiffness, speed = draw.size(1e5, 1e7), draw.size(0.02, 1.0)
    radius = clearance * draw.size(3.0, 300.0)
    heading, at = draw.even(0.0, 2.0 * math.pi), draw.even(0.0, 2.0 * math.pi)
    aside = clearance * draw.even(0.0, 0.9)
    slip = draw.size(1e-3, 2e-2)
    friction = {
        "law": "modified-coulomb",
        "coefficient": draw.one_of(0.0, 1.0, 1.0, 1.0) * draw.size(1e-4, 2e-2),
        "static_velocity": slip,
        "dynamic_velocity": 2.0 * slip,
    }
    depth = (1.25 * mass * speed**2 / stiffness) ** 0.4
    duration, gravity = SWINGS * 2.94 * depth / speed, draw.one_of(0.0, -9.81)
    rotor = {
        "mass": mass,
        "inertia": mass * draw.size(1e-4, 1e-2),
        "points": {"pin": [clearance * draw.even(0.0, 0.9), 0.0]},
    }
    contact = {
        "law": "lankarani-nikravesh",
        "stiffness": stiffness,
        "restitution": draw.even(0.8, 1.0),
    }
    fit = {
        "radial_clearance": clearance,
        "bearing_radius": radius,
        "contact": contact,
        "friction": friction,
    }
    start = {
        "angles": {"rotor": 0.0},
        "angular_velocities": {"rotor": draw.even(-200.0, 200.0)},
        "velocities": {"rotor": [speed * math.cos(heading), speed * math.sin(heading)]},
        "joints": {"J": {"eccentricity": [aside * math.cos(at), aside * math.sin(at)]}},
    }
    scene = rotor_in_bearing("soft-contact", gravity, rotor, fit, start)
    return {"kind": "simulate", "scene": scene, "duration": float(f"{duration:.9g}")}
