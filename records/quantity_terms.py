"""Other terms for the quantities of channels, such as `angle` for `theta`."""

from collections.abc import Container

_XY = ("x", "y")
_DIRECTED = {
    "position": _XY,
    "velocity": ("vx", "vy"),
    "acceleration": ("ax", "ay"),
    "eccentricity": ("eccentricity_x", "eccentricity_y"),
    "eccentricity_rate": ("eccentricity_rate_x", "eccentricity_rate_y"),
    "force": ("force_x", "force_y"),
}
_TERMS = {
    "angle": ("theta",),
    "rotation": ("theta",),
    "phi": ("theta",),
    "angular_velocity": ("omega",),
    "angular_speed": ("omega",),
    "rate": ("omega",),
    "angular_acceleration": ("alpha",),
    "speed": ("omega", "vx", "vy"),
    "contact_force": ("normal_force",),
    "friction": ("friction_force",),
    "slip": ("slip_velocity",),
    "slip_rate": ("slip_velocity",),
    "sliding_velocity": ("slip_velocity",),
    "depth": ("penetration",),
    "moment": ("torque",),
    "torque": ("moment",),
    **_DIRECTED,
    **{f"{term}_{_XY[i]}": (names[i],) for term, names in _DIRECTED.items() for i in (0, 1)},
}
"""The quantities that each term may mean. By letters alone, `angle` is nearest to `ay`."""


def in_other_terms(name: str, known: Container[str]) -> list[str]:
    """Return the known channels that a name may mean: `rocker.theta` of `rocker.angle`."""
    part, _, term = name.rpartition(".")
    meant = _TERMS.get(term.casefold().replace("-", "_").replace(" ", "_"), ())
    return [found for found in (f"{part}.{quantity}" for quantity in meant) if found in known]
