"""A part of 45 g that 12 N press against a wall: friction holds it up, and nothing is driven.

It creeps by W v / (mu N), v the slip at which modified Coulomb friction is full: 52.55 um/s.
"""

import math
from typing import Any

WEIGHT, PUSH, FRICTION, FULL = 0.045 * 9.81, 12.0, 0.7, 1e-3
CREEP = WEIGHT * FULL / (FRICTION * PUSH)


def held_part(speed: float = 0.0) -> dict[str, Any]:
    """Return the scene; `speed` : upwards, at the start, m/s."""
    clearance = {
        "wall_clearance": 1e-4,
        "length": 0.02,
        "height": 0.008,
        "contact": {
            "law": "stiffness-and-dissipation",
            "stiffness": {"law": "power", "stiffness": 1e5, "exponent": 1.0},
            "dissipation": {"law": "kelvin-voigt", "damping": 2.0 * math.sqrt(1e5 * 0.045)},
        },
        "friction": {
            "law": "modified-coulomb",
            "coefficient": FRICTION,
            "static_velocity": 0,
            "dynamic_velocity": FULL,
        },
    }
    return {
        "name": "held-part",
        "bodies": {"part": {"mass": 0.045, "inertia": 1e-6, "points": {"c": [0, 0]}}},
        "ground": {"points": {"O": [0, 0]}},
        "joints": {
            "pad": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "part.c",
                "axis": [0, 1],
                "clearance": clearance,
            }
        },
        "forces": {
            "push": {
                "type": "force",
                "first": "ground.O",
                "second": "part.c",
                "magnitude": PUSH,
                "direction": [-1, 0],
            }
        },
        "gravity": [0, -9.81],
        "start": {
            "guides": {"pad": {"offset": 1.6e-4}},
            "velocities": {"part": [0, speed]},
        },
    }
