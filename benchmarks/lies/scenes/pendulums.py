"""Pendulums whose pivot has play, or that hang on one another."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import bearing


def _rod(draw: Draw) -> dict[str, Any]:
    half, mass = draw.even(0.05, 0.5), draw.size(0.1, 10.0)
    return {
        "mass": mass,
        "inertia": mass * half * half * draw.even(0.1, 0.5),
        "points": {"a": [-half, 0.0], "b": [half, 0.0]},
    }


def loose(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a rod that hangs in a bearing with play."""
    clearance = draw.size(5e-5, 1e-2)
    scene = {
        "name": "loose-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rod": _rod(draw)},
        "joints": {
            "O": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "rod.a",
                "clearance": bearing(draw, clearance),
            }
        },
        "start": {
            "angles": {"rod": draw.even(-3.0, 3.0)},
            "angular_velocities": {"rod": draw.even(-20.0, 20.0)},
        },
    }
    return scene, 0.03


def double(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a rod that hangs, with play, on another one, a spring at its end."""
    clearance = draw.size(5e-5, 1e-2)
    scene = {
        "name": "double-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "wall": [0.3, 0.6]}},
        "bodies": {"upper": _rod(draw), "lower": _rod(draw)},
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "upper.a"},
            "P": {
                "type": "revolute",
                "bearing": "upper.b",
                "journal": "lower.a",
                "clearance": bearing(draw, clearance),
            },
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "lower.b",
                "stiffness": draw.size(1.0, 1e4),
                "damping": draw.size(0.01, 10.0),
                "free_length": draw.even(0.1, 1.0),
            }
        },
        "start": {
            "angles": {"upper": draw.even(-3.0, 3.0), "lower": draw.even(-3.0, 3.0)},
            "angular_velocities": {"upper": draw.even(-5.0, 5.0), "lower": draw.even(-5.0, 5.0)},
        },
    }
    return scene, 0.03
