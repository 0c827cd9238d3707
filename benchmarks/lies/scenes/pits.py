"""A ring on a pin that turns: bodies that fly freely inside play, shaken by a motor."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import bearing


def ring_on_pin(
    gravity: float,
    pin: float,
    ring: tuple[float, float],
    play: dict[str, Any],
    motor: tuple[float, float],
    start: dict[str, Any],
) -> dict[str, Any]:
    """Return a ring with play on a pin that a motor turns.

    Parameters
    ----------
    gravity
        Along y, m/s^2.
    pin
        Distance from the motor, m.
    ring
        Mass, kg, and inertia, kg m^2.
    play
        Field "clearance" of their joint.
    motor
        Position, rad, and speed, rad/s.
    start
        Of the ring: "velocity", "angular_velocity", and the joint's "eccentricity".
    """
    mass, inertia = ring
    position, speed = motor
    return {
        "name": "pit",
        "gravity": [0.0, gravity],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "crank": {
                "mass": 0.3,
                "inertia": 1e-4,
                "points": {"O": [0.0, 0.0], "pin": [pin, 0.0]},
            },
            "ring": {"mass": mass, "inertia": inertia, "points": {"eye": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "E": {
                "type": "revolute",
                "bearing": "crank.pin",
                "journal": "ring.eye",
                "clearance": play,
            },
        },
        "drivers": {"motor": {"joint": "O", "position": position, "speed": speed}},
        "start": {
            "angles": {"ring": 0.0},
            "velocities": {"ring": start["velocity"]},
            "angular_velocities": {"ring": start["angular_velocity"]},
            "joints": {"E": {"eccentricity": start["eccentricity"]}},
        },
    }


def _pit(draw: Draw, slow: dict[str, Any]) -> tuple[dict[str, Any], float]:
    clearance, speed = draw.size(1e-4, 2e-2), draw.size(20.0, 600.0)
    eccentricity = clearance * draw.even(0.05, 0.95)
    aside = clearance * draw.even(-0.25, 0.25)
    throw = draw.even(-0.2, 0.2)
    scene = ring_on_pin(
        draw.one_of(-9.81, 0.0),
        eccentricity,
        (draw.size(0.1, 10.0), draw.size(1e-4, 1.0)),
        bearing(draw, clearance),
        (draw.even(0.0, 6.28), speed),
        {
            "velocity": [throw, 0.1],
            "angular_velocity": draw.even(-100.0, 100.0),
            "eccentricity": [aside, -2.0 * aside],
        },
    )
    if slow:
        scene["ground"]["points"]["T"] = [1.0, 0.0]
        scene["bodies"]["table"] = {
            "mass": 1.0,
            "inertia": 0.01,
            "points": {"O": [0.0, 0.0], "tip": [0.2, 0.0]},
        }
        scene["joints"]["T"] = {"type": "revolute", "bearing": "ground.T", "journal": "table.O"}
        scene["drivers"]["slow"] = {"joint": "T", "speed": speed * slow["ratio"]}
    return scene, 2.0 / speed


def shaken(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a ring on an eccentric pin."""
    return _pit(draw, {})


def two_motors(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the same beside a table that touches nothing and turns at another speed."""
    return _pit(draw, {"ratio": draw.one_of(0.001, 0.01, 0.1, 0.999, 0.7071, 1.0)})
