"""The presets that the independent program does not know, with random parameters."""

import math
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.presets import preset

Ends = tuple[float, float]


def four_bar(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the four-bar with play in one of its pins."""
    clearance, speed = draw.size(5e-5, 5e-3), draw.size(3.0, 300.0)
    scene = preset(
        "four-bar",
        clearance=clearance,
        bearing_radius=clearance * draw.size(1.5, 50.0),
        restitution=draw.even(0.1, 1.0),
        friction=draw.size(0.01, 0.5),
        speed=speed * draw.one_of(1.0, -1.0),
    )
    return scene, 0.3 / speed


def driven_pendulum(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the pendulum whose pin goes round."""
    speed = draw.size(0.3, 100.0)
    scene = preset(
        "driven-pendulum",
        speed=speed * draw.one_of(1.0, -1.0),
        radius=draw.size(0.01, 0.5),
        angle=draw.even(-3.0, 3.0),
        angular_velocity=draw.one_of(0.0, 1.0, -1.0) * draw.size(0.1, 30.0),
        gravity_y=draw.one_of(-9.81, -9.81, 0.0),
    )
    return scene, 2.0 * math.pi / max(speed, 3.0)


def impact_oscillator(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the shaken mass that strikes a stop."""
    speed, stiffness = draw.size(3.0, 100.0), draw.size(40.0, 4000.0)
    scene = preset(
        "impact-oscillator",
        gap=draw.one_of(1.0, 1.0, -1.0) * draw.size(1e-4, 0.02),
        amplitude=draw.size(5e-4, 0.02),
        speed=speed,
        stiffness=stiffness,
        damping=draw.size(0.1, 20.0),
        stop_stiffness=draw.size(1e6, 1e12),
        restitution=draw.even(0.1, 1.0),
    )
    return scene, 2.0 * math.pi / max(speed, math.sqrt(stiffness))


def jansen_leg(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the leg of eight bars."""
    return _with_play(draw, "jansen-leg", (0.3, 30.0), (2e-5, 1e-3), 0.1)


def quick_return(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the quick-return mechanism, whose slotted lever has play."""
    return _with_play(draw, "quick-return", (0.5, 50.0), (5e-5, 3e-3), 0.2)


def _with_play(
    draw: Draw, name: str, speeds: Ends, clearances: Ends, angle: float
) -> tuple[dict[str, Any], float]:
    speed = draw.size(*speeds)
    scene = preset(
        name,
        clearance=draw.size(*clearances),
        restitution=draw.even(0.1, 1.0),
        friction=draw.size(0.01, 0.5),
        speed=speed * draw.one_of(1.0, -1.0),
    )
    return scene, angle / speed


def squeezer(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return Andrews' squeezer mechanism, all of whose joints are ideal."""
    scene = preset(
        "andrews-squeezer",
        torque=draw.even(0.01, 0.06),
        stiffness=draw.size(1000.0, 1e4),
        free_length=draw.even(0.07, 0.09),
    )
    return scene, 0.003


def punching_press(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the press that works against a punch."""
    clearance, speed = draw.size(5e-5, 3e-3), draw.size(0.3, 30.0)
    scene = preset(
        "seven-bar-press-punching",
        punch_force=draw.size(20.0, 2e4),
        clearance=clearance,
        bearing_radius=clearance * draw.size(1.5, 20.0),
        restitution=draw.even(0.1, 1.0),
        friction=draw.size(0.01, 0.5),
        speed=speed,
    )
    return scene, min(0.2 / speed, 0.05)
