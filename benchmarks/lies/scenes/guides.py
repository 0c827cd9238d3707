"""A slider with play in a guide on an arm that swings, held by a spring."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.surfaces import contact, coulomb, lugre


def swung(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the slider with friction that has bends."""
    return _guide(draw, coulomb(draw))


def bristled(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return it with bristles at its corners."""
    return _guide(draw, lugre(draw))


def _guide(draw: Draw, friction: dict[str, Any]) -> tuple[dict[str, Any], float]:
    length, mass = draw.size(0.02, 0.3), draw.size(0.1, 10.0)
    clearance, swings = length * draw.size(3e-4, 3e-3), draw.size(10.0, 100.0)
    scene = {
        "name": "swung-guide",
        "gravity": [draw.even(-10.0, 10.0), draw.even(-10.0, 10.0)],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "arm": {
                "mass": 1.0,
                "inertia": 0.1,
                "points": {"O": [0.0, 0.0], "guide": [length, 0.0], "far": [4.0 * length, 0.0]},
            },
            "slider": {
                "mass": mass,
                "inertia": mass * length**2 * draw.size(0.1, 0.5),
                "points": {
                    "centre": [length * draw.even(-0.3, 0.3), length * draw.even(-0.1, 0.1)]
                },
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "arm.O"},
            "guide": {
                "type": "prismatic",
                "guide": "arm.guide",
                "slider": "slider.centre",
                "axis": [1.0, draw.even(-0.5, 0.5)],
                "clearance": {
                    "wall_clearance": clearance,
                    "length": length,
                    "height": length * draw.even(0.2, 1.0),
                    "contact": contact(draw),
                    "friction": friction,
                },
            },
        },
        "drivers": {
            "motor": {
                "joint": "O",
                "motion": {
                    "type": "sinusoidal",
                    "amplitude": draw.size(0.02, 0.5),
                    "frequency": swings,
                },
            }
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "arm.far",
                "second": "slider.centre",
                "stiffness": mass * swings**2 * draw.size(0.3, 10.0),
                "damping": mass * swings * draw.size(1e-3, 1e-1),
                "free_length": length * draw.even(2.0, 4.0),
            }
        },
        "start": {"guides": {"guide": {"offset": clearance * draw.even(-0.5, 0.5), "tilt": 0.0}}},
    }
    return scene, 0.3 / swings
