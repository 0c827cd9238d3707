"""A crank's pin with play in the slot of a rocker, and in that of a yoke that a motor drives."""

import math
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.drives import motor, turning
from benchmarks.lies.scenes.surfaces import contact, coulomb, lugre


def rocker(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a rocker, held by a torsion spring and rubbed by bristles, that a crank swings."""
    crank, speed = draw.size(0.01, 0.1), draw.size(3.0, 100.0)
    mass, arm = draw.size(0.02, 2.0), crank * draw.even(2.0, 6.0)
    scene = {
        "name": "slotted-rocker",
        "gravity": [0.0, draw.one_of(0.0, -9.81)],
        "ground": {"points": {"O": [0.0, 0.0], "R": [0.0, -arm]}},
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": 1e-3,
                "points": {"O": [0.0, 0.0], "pin": [crank, 0.0]},
            },
            "rocker": {
                "mass": mass,
                "inertia": mass * arm**2 * draw.size(0.05, 1.0),
                "points": {"R": [0.0, -arm], "slot": [0.0, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "R": {"type": "revolute", "bearing": "ground.R", "journal": "rocker.R"},
            "slot": _slot(draw, "rocker.slot", "crank.pin", crank, lugre(draw)),
        },
        "drivers": {
            "motor": {
                "joint": "O",
                "position": draw.even(0.0, 2.0 * math.pi),
                "speed": speed * draw.one_of(1.0, -1.0),
            }
        },
        "forces": {
            "spring": {
                "type": "torsion-spring",
                "first": "ground.R",
                "second": "rocker.R",
                "stiffness": mass * (arm * speed) ** 2 * draw.size(0.1, 10.0),
                "damping": mass * arm**2 * speed * draw.size(1e-3, 1e-1),
                "free_angle": draw.even(-0.3, 0.3),
            }
        },
    }
    return scene, 0.3 / speed


def yoke(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a motor with a flywheel that drives a yoke by a pin."""
    crank, speed = draw.size(0.01, 0.1), draw.size(10.0, 200.0)
    mass = draw.size(0.05, 5.0)
    inertia = mass * crank**2 * draw.size(1.0, 30.0)
    scene = {
        "name": "motor-and-yoke",
        "gravity": [draw.one_of(0.0, -9.81), 0.0],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "flywheel": {
                "mass": 1.0,
                "inertia": inertia,
                "points": {"O": [0.0, 0.0], "pin": [crank, 0.0]},
            },
            "yoke": {"mass": mass, "inertia": 1e-3, "points": {"slot": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "flywheel.O"},
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "yoke.slot",
                "axis": [1.0, 0.0],
            },
            "slot": _slot(draw, "yoke.slot", "flywheel.pin", crank, coulomb(draw)),
        },
        "forces": {"motor": motor(draw, "flywheel.O", inertia, speed)},
        "start": turning(draw, "flywheel", speed, 0.0),
    }
    return scene, 0.5 / speed


def _slot(
    draw: Draw, slot: str, pin: str, crank: float, friction: dict[str, Any]
) -> dict[str, Any]:
    return {
        "type": "pin-in-slot",
        "slot": slot,
        "pin": pin,
        "axis": [0.0, 1.0],
        "clearance": {
            "wall_clearance": crank * draw.size(3e-4, 1e-2),
            "pin_radius": crank * draw.even(0.1, 0.3),
            "contact": contact(draw),
            "friction": friction,
        },
    }
