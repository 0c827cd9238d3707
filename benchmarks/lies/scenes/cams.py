"""Cams whose followers may lift off: a flat face, and a roller on an arm that a motor drives."""

import math
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.drives import motor
from benchmarks.lies.scenes.surfaces import contact, coulomb, lugre


def flat(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a flat follower in a straight guide, on a cam that turns steadily."""
    base, speed = draw.size(0.005, 0.05), draw.size(10.0, 200.0)
    lift, mass = base * draw.even(0.05, 0.3), draw.size(0.02, 2.0)
    clearance = _lash(draw, base, coulomb(draw))
    profile = _profile(draw, base, lift, 1.0)
    scene = {
        "name": "flat-follower",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "top": [0.0, 10.0 * base]}},
        "bodies": {
            "cam": {"mass": 1.0, "inertia": 1e-3, "points": {"O": [0.0, 0.0]}},
            "follower": {"mass": mass, "inertia": 1e-3, "points": {"face": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "cam.O"},
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "follower.face",
                "axis": [0.0, 1.0],
            },
            "contact": {
                "type": "flat-follower",
                "cam": "cam.O",
                "follower": "follower.face",
                "normal": [0.0, 1.0],
                "profile": profile,
                "clearance": clearance,
            },
        },
        "drivers": {"motor": {"joint": "O", "speed": speed * draw.one_of(1.0, -1.0)}},
        "forces": {"spring": _spring(draw, "ground.top", "follower.face", mass, speed, base)},
        "start": {"guides": {"contact": {"offset": clearance["lash"] * draw.even(-0.9, 3.0)}}},
    }
    return scene, 0.4 / speed


def roller(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a roller on an arm, rubbed by bristles, on a cam with a flywheel and a motor."""
    base, speed = draw.size(0.005, 0.05), draw.size(10.0, 200.0)
    lift, mass = base * draw.even(0.05, 0.3), draw.size(0.02, 2.0)
    arm, inertia = base * draw.even(4.0, 8.0), mass * base**2 * draw.size(1.0, 100.0)
    clearance = _lash(draw, base, lugre(draw))
    profile = _profile(draw, base, lift, draw.one_of(1.0, 2.0))
    scene = {
        "name": "roller-on-an-arm",
        "gravity": [0.0, -9.81],
        "ground": {
            "points": {"O": [0.0, 0.0], "A": [-arm, base + lift], "top": [0.0, 10.0 * base]}
        },
        "bodies": {
            "cam": {"mass": 1.0, "inertia": inertia, "points": {"O": [0.0, 0.0]}},
            "arm": {
                "mass": mass,
                "inertia": mass * arm**2 * draw.size(0.05, 0.3),
                "points": {"A": [-0.5 * arm, 0.0], "roller": [0.5 * arm, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "cam.O"},
            "A": {"type": "revolute", "bearing": "ground.A", "journal": "arm.A"},
            "contact": {
                "type": "roller-follower",
                "cam": "cam.O",
                "follower": "arm.roller",
                "roller_radius": base * draw.even(0.2, 0.5),
                "profile": profile,
                "clearance": clearance,
            },
        },
        "forces": {
            "spring": _spring(draw, "ground.top", "arm.roller", mass, speed, base),
            "motor": motor(draw, "cam.O", inertia, speed),
        },
        "start": {
            "angular_velocities": {"cam": speed},
            "guides": {"contact": {"offset": clearance["lash"] * draw.even(-0.9, 3.0)}},
        },
    }
    return scene, 0.4 / speed


def _profile(draw: Draw, base: float, lift: float, waves: float) -> dict[str, Any]:
    return {
        "type": "sinusoidal",
        "amplitude": lift,
        "frequency": waves,
        "offset": base + lift,
        "phase": draw.even(0.0, 2.0 * math.pi),
    }


def _lash(draw: Draw, base: float, friction: dict[str, Any]) -> dict[str, Any]:
    return {
        "lash": base * draw.size(1e-3, 3e-2),
        "contact": contact(draw),
        "friction": friction,
    }


def _spring(
    draw: Draw, first: str, second: str, mass: float, speed: float, base: float
) -> dict[str, Any]:
    return {
        "type": "spring-damper",
        "first": first,
        "second": second,
        "stiffness": mass * speed**2 * draw.size(0.1, 5.0),
        "damping": mass * speed * draw.size(1e-3, 1e-1),
        "free_length": base * draw.even(9.0, 12.0),
    }
