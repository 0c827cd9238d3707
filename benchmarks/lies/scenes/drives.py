"""Motors with flywheels, and how these turn at first."""

from typing import Any

from benchmarks.lies.draw import Draw


def motor(draw: Draw, rotor: str, inertia: float, speed: float) -> dict[str, Any]:
    """Return a motor on the ground that brings a point's body to a speed, rad/s, or beyond."""
    return {
        "type": "motor",
        "first": "ground.O",
        "second": rotor,
        "stall_torque": inertia * speed**2 * draw.size(0.03, 3.0),
        "no_load_speed": speed * draw.even(1.0, 2.0),
    }


def turning(draw: Draw, body: str, speed: float, least: float) -> dict[str, Any]:
    """Return the start of a body at any angle, with at least that share of the speed, rad/s."""
    return {
        "angles": {body: draw.even(-3.0, 3.0)},
        "angular_velocities": {body: speed * draw.even(least, 1.0)},
    }
