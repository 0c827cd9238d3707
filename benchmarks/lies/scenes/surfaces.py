"""Random contact and friction of surfaces that are not those of a bearing."""

from typing import Any

from benchmarks.lies.draw import Draw


def contact(draw: Draw) -> dict[str, Any]:
    """Return a law of contact."""
    return {
        "law": "lankarani-nikravesh",
        "stiffness": draw.size(1e8, 1e11),
        "restitution": draw.even(0.2, 0.95),
    }


def coulomb(draw: Draw) -> dict[str, Any]:
    """Return friction with bends."""
    slip = draw.size(1e-4, 1e-1)
    return {
        "law": "modified-coulomb",
        "coefficient": draw.size(0.01, 0.4),
        "dynamic_velocity": slip,
        "static_velocity": slip * draw.one_of(0.1, 0.5),
    }


def lugre(draw: Draw) -> dict[str, Any]:
    """Return friction with damped bristles."""
    kinetic = draw.size(0.02, 0.4)
    return {
        "law": "lugre",
        "static_coefficient": kinetic * draw.even(1.05, 1.6),
        "kinetic_coefficient": kinetic,
        "stribeck_velocity": draw.size(1e-3, 1e-1),
        "bristle_stiffness": draw.size(100.0, 5000.0),
        "bristle_damping": draw.even(0.0, 3.0),
        "viscous_damping": draw.even(0.0, 0.02),
    }


def dahl(draw: Draw) -> dict[str, Any]:
    """Return friction with bristles."""
    return {
        "law": "dahl",
        "coefficient": draw.size(0.02, 0.4),
        "bristle_stiffness": draw.size(100.0, 5000.0),
    }
