"""The presets, with random parameters."""

import math
from typing import Any

from benchmarks.lies.draw import Draw


def preset(name: str, **parameters: Any) -> dict[str, Any]:
    """Return a preset with some parameters set."""
    return {"preset": name, "parameters": parameters}


def _laws(draw: Draw, stiffest: float) -> dict[str, float]:
    slip = draw.size(1e-5, 1e-1)
    return {
        "stiffness": draw.size(1e7, stiffest),
        "restitution": draw.even(0.1, 1.0),
        "friction": draw.size(0.01, 0.5),
        "dynamic_velocity": slip,
        "static_velocity": slip * draw.one_of(0.0, 0.1, 0.5, 0.9),
    }


def pendulum(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a rod on a pin, from rest to a thousand rad/s, with gravity and without."""
    gravity, spin = draw.one_of(-9.81, -9.81, 0.0, -1e-3), draw.one_of(0.0, 1.0, -1.0)
    speed = spin * draw.size(0.1, 1000.0)
    scene = preset(
        "pendulum",
        gravity_y=gravity,
        angle=draw.even(-3.0, 3.0),
        angular_velocity=speed,
        inertia=draw.size(0.01, 1.0),
    )
    rates = [abs(speed), math.sqrt(abs(gravity)), 0.1]
    return scene, 2.0 * math.pi / max(rates)


def journal(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a disc thrown about in its bearing, with gravity and without."""
    clearance = draw.size(2e-5, 5e-3)
    gravity, throw = draw.one_of(-9.81, -9.81, -1.0, 0.0), draw.size(0.01, 3.0)
    heading, at, aside = draw.even(0.0, 6.283), draw.even(0.0, 6.283), draw.even(0.0, 0.95)
    scene = preset(
        "bouncing-journal",
        clearance=clearance,
        bearing_radius=clearance * draw.size(1.5, 50.0),
        velocity_x=throw * math.cos(heading),
        velocity_y=throw * math.sin(heading),
        spin=draw.one_of(0.0, 1.0, -1.0) * draw.size(1.0, 3000.0),
        position_x=aside * clearance * math.cos(at),
        position_y=aside * clearance * math.sin(at),
        gravity_y=gravity,
        **_laws(draw, 1e12),
    )
    return scene, min(2.0 * clearance / throw, 2.0 * math.sqrt(clearance / max(-gravity, 1e-9)))


def slider_crank(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the slider-crank."""
    clearance, speed = draw.size(5e-5, 5e-3), draw.size(10.0, 600.0)
    scene = preset(
        "slider-crank",
        clearance=clearance,
        bearing_radius=clearance * draw.size(1.5, 50.0),
        speed=speed * draw.one_of(1.0, -1.0),
        **_laws(draw, 1e13),
    )
    return scene, 0.2 / speed


def press(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the press."""
    return _press("seven-bar-press", draw)


def fitted_press(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the press with the fitted exponent; the stiffness is that of its force at 10 um."""
    scene, unit = _press("seven-bar-press-fitted", draw)
    scene["parameters"]["stiffness"] *= (1e-5) ** (1.5 - 1.266)
    return scene, unit


def _press(name: str, draw: Draw) -> tuple[dict[str, Any], float]:
    one, two = draw.size(5e-5, 3e-3), draw.size(5e-5, 3e-3)
    speed = draw.size(0.3, 30.0)
    ratio = draw.one_of(1.0, -1.0, 2.0, 0.5, 0.7071, 0.01, 30.0)
    scene = preset(
        name,
        clearance_A=one,
        clearance_B=two,
        bearing_radius=max(one, two) * draw.size(1.5, 20.0),
        speed=speed,
        speed_crank4=speed * ratio,
        gravity_x=draw.one_of(9.81, 9.81, 0.0),
        slip_velocity=draw.one_of("material", "as-published"),
        **_laws(draw, 1e12),
    )
    return scene, min(0.2 / (speed * max(1.0, abs(ratio))), 0.05)
