"""A random joint with play: its fit, contact and friction; a rotor in such a joint."""

from typing import Any

from benchmarks.lies.draw import Draw


def bearing(draw: Draw, clearance: float) -> dict[str, Any]:
    """Return the field "clearance" of a joint whose radial clearance is given, m."""
    slip = draw.size(1e-5, 1e-1)
    return {
        "radial_clearance": clearance,
        "bearing_radius": clearance * draw.size(1.5, 50.0),
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": draw.size(1e7, 1e12),
            "restitution": draw.even(0.1, 1.0),
        },
        "friction": {
            "law": "modified-coulomb",
            "coefficient": draw.size(0.01, 0.5),
            "dynamic_velocity": slip,
            "static_velocity": slip * draw.one_of(0.0, 0.1, 0.5, 0.9),
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
