"""A random joint with play: its fit, contact and friction; a rotor in such a joint."""

from typing import Any

from benchmarks.lies.draw import Draw


def bearing(draw: Draw, clearance: float) -> dict[str, Any]:
    """Return the field "clearance" of a joint whose radial clearance is given, m."""
    slip = draw.size(1e-5, 1e-1)
    radius = clearance * draw.size(1.5, 50.0)
    contact = draw.size(1e7, 1e12), draw.even(0.1, 1.0)
    friction = draw.size(0.01, 0.5), slip, slip * draw.one_of(0.0, 0.1, 0.5, 0.9)
    return play(clearance, radius, contact, friction)


def play(
    clearance: float,
    radius: float,
    contact: tuple[float, float],
    friction: tuple[float, float, float],
) -> dict[str, Any]:
    """Return the field "clearance" of a joint.

    Parameters
    ----------
    clearance, radius
        Radial clearance and radius of the bearing, m.
    contact
        Stiffness, N/m^1.5, and restitution coefficient.
    friction
        Coefficient, and slip from which on it is full and up to which there is none, m/s.
    """
    stiffness, restitution = contact
    coefficient, full, none = friction
    return {
        "radial_clearance": clearance,
        "bearing_radius": radius,
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": stiffness,
            "restitution": restitution,
        },
        "friction": {
            "law": "modified-coulomb",
            "coefficient": coefficient,
            "dynamic_velocity": full,
            "static_velocity": none,
        },
    }


def rotor_in_bearing(
    name: str,
    gravity: float,
    rotor: dict[str, Any],
    clearance: dict[str, Any],
    start: dict[str, Any],
) -> dict[str, Any]:
    """Return the scene of the body `rotor`, whose point `pin` has play in the joint `J`.

    gravity : along y, m/s^2.
    """
    pin = {"type": "revolute", "bearing": "ground.O", "journal": "rotor.pin"}
    return {
        "name": name,
        "gravity": [0.0, gravity],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rotor": rotor},
        "joints": {"J": pin | {"clearance": clearance}},
        "start": start,
    }
