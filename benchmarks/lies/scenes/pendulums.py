"""Pendulums whose pivot has play, or that hang on one another."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import bearing


def _rod(draw: Draw) -> dict[str, Any]:
    half, mass = draw.even(0.05, 0.5), draw.size(0.1, 10.0)
    return rod(half, mass, mass * half * half * draw.even(0.1, 0.5))


def rod(half: float, mass: float, inertia: float) -> dict[str, Any]:
    """Return a body of half a length, m, a mass, kg, and an inertia, kg m^2."""
    return {"mass": mass, "inertia": inertia, "points": {"a": [-half, 0.0], "b": [half, 0.0]}}


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
    scene = double_pendulum(
        (_rod(draw), _rod(draw)),
        bearing(draw, clearance),
        (draw.size(1.0, 1e4), draw.size(0.01, 10.0), draw.even(0.1, 1.0)),
        (draw.even(-3.0, 3.0), draw.even(-3.0, 3.0)),
        (draw.even(-5.0, 5.0), draw.even(-5.0, 5.0)),
    )
    return scene, 0.03


def double_pendulum(
    rods: tuple[dict[str, Any], dict[str, Any]],
    play: dict[str, Any],
    spring: tuple[float, float, float],
    angles: tuple[float, float],
    rates: tuple[float, float],
) -> dict[str, Any]:
    """Return the scene of `double`.

    Parameters
    ----------
    rods
        The upper and the lower one.
    play
        Field "clearance" of the joint between them.
    spring
        Stiffness, N/m, damping, N s/m, and free length, m.
    angles, rates
        Of both rods at the start, rad and rad/s.
    """
    stiffness, damping, free_length = spring
    names = ("upper", "lower")
    return {
        "name": "double-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "wall": [0.3, 0.6]}},
        "bodies": dict(zip(names, rods, strict=True)),
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "upper.a"},
            "P": {
                "type": "revolute",
                "bearing": "upper.b",
                "journal": "lower.a",
                "clearance": play,
            },
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "lower.b",
                "stiffness": stiffness,
                "damping": damping,
                "free_length": free_length,
            }
        },
        "start": {
            "angles": dict(zip(names, angles, strict=True)),
            "angular_velocities": dict(zip(names, rates, strict=True)),
        },
    }
