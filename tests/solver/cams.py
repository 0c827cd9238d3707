"""Scenes of cams: an eccentric circle and tables, with a flat face or a roller on a tappet."""

import math
from typing import Any

RADIUS, ECCENTRICITY, ROLLER = 0.03, 0.01, 0.008
SPEED = 20.0
LAW = {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": 0.7}
CIRCLE = {"type": "sinusoidal", "offset": RADIUS, "amplitude": -ECCENTRICITY, "frequency": 1.0}
"""Support function of an eccentric circle: a face above it rises by e (1 - cos) of the angle."""


def pitch_table(knots: int = 64) -> dict[str, Any]:
    """Return the path of a roller's centre about an eccentric circle, as a periodic table."""
    angles = [2.0 * math.pi * k / (knots - 1) for k in range(knots)]
    reach = RADIUS + ROLLER
    values = [
        -ECCENTRICITY * math.sin(a) + math.sqrt(reach**2 - (ECCENTRICITY * math.cos(a)) ** 2)
        for a in angles
    ]
    values[-1] = values[0]
    return {"type": "table", "knots": angles, "values": values, "outside": "periodic"}


def follower(
    shape: str, profile: dict[str, Any], *, lash: float = 0.0, cam: str = "O", **clearance: Any
) -> dict[str, Any]:
    """Return the joint of a cam and the face, or the roller, of a tappet."""
    own = {"normal": [0.0, 2.0]} if shape == "flat" else {"roller_radius": ROLLER}
    play = {"lash": lash, "contact": LAW} | clearance
    ends = {"cam": f"shaft.{cam}", "follower": "tappet.F"}
    return {"type": f"{shape}-follower", "profile": profile, "clearance": play} | ends | own


def valve(joint: dict[str, Any], driven: bool = True) -> dict[str, Any]:
    """Return a camshaft below a tappet that slides upright, pressed down by a spring."""
    shaft = {"O": [0.0, 0.0], "C": [0.0, -ECCENTRICITY]}
    scene: dict[str, Any] = {
        "name": "valve",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "G": [0.0, 0.05], "S": [0.0, 0.2]}},
        "bodies": {
            "shaft": {"mass": 0.8, "inertia": 5e-4, "points": shaft},
            "tappet": {"mass": 0.2, "inertia": 1e-4, "points": {"F": [0.0, -0.02]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "shaft.O"},
            "guide": {
                "type": "prismatic",
                "guide": "ground.G",
                "slider": "tappet.F",
                "axis": [0.0, 1.0],
            },
            "cam": joint,
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.S",
                "second": "tappet.F",
                "stiffness": 2e3,
                "free_length": 0.25,
            }
        },
        "start": {"points": {"tappet.F": [0.0, 0.03]}},
    }
    if driven:
        return scene | {"drivers": {"motor": {"joint": "O", "speed": SPEED}}}
    scene["start"]["angular_velocities"] = {"shaft": SPEED}
    return scene


def rocker(joint: dict[str, Any]) -> dict[str, Any]:
    """Return the same with a rocker on a pin in place of the tappet, all of it aslant."""
    scene = valve(joint, driven=False)
    scene["ground"]["points"] |= {"P": [-0.15, 0.04], "S": [0.02, 0.2]}
    scene["start"]["points"] = {"tappet.F": [0.0, 0.03], "tappet.P": [-0.15, 0.04]}
    points = {"F": [0.09, -0.01], "P": [-0.06, 0.0]}
    scene["bodies"]["tappet"] = {"mass": 0.3, "inertia": 2e-3, "points": points}
    scene["joints"]["guide"] = {"type": "revolute", "bearing": "ground.P", "journal": "tappet.P"}
    return scene
