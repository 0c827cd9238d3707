"""Weightless journals, each thrown against its own bearing, by any stiffness and dissipation."""

from typing import Any

from jointplay.solver.kinds import admit
from jointplay.solver.scene.document import Scene

CLEARANCE, SPEED, MASS = 5e-4, 0.2, 1.0
SPIN, INERTIA = 200.0, 5e-5
APART = 1e-5
"""Distance by which each journal starts nearer to its bearing than the one before, m."""


def pair(stiffness: dict[str, Any], dissipation: dict[str, Any]) -> dict[str, Any]:
    """Return the contact law of two parts."""
    law = "stiffness-and-dissipation"
    return {"law": law, "stiffness": stiffness, "dissipation": dissipation}


def spinning(contact: dict[str, Any], *friction: dict[str, Any]) -> dict[str, Any]:
    """Return a scene with a journal for each friction law, which spin as they are thrown."""
    scene = thrown(*(len(friction) * [contact]))
    for i, law in enumerate(friction):
        scene["joints"][f"bearing{i}"]["clearance"]["friction"] = law
        scene["bodies"][f"journal{i}"]["inertia"] = INERTIA
    scene["start"]["angular_velocities"] = dict.fromkeys(scene["bodies"], SPIN)
    return scene


def thrown(*laws: dict[str, Any]) -> dict[str, Any]:
    """Return a scene with a journal for each contact law."""
    points = {"points": {"O": [0.0, 0.0]}}
    return {
        "name": "thrown-journals",
        "ground": points,
        "bodies": {
            f"journal{i}": {"mass": MASS, "inertia": 1.0} | points for i in range(len(laws))
        },
        "joints": {
            f"bearing{i}": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": f"journal{i}.O",
                "clearance": {
                    "radial_clearance": CLEARANCE,
                    "bearing_radius": 0.01,
                    "bearing_width": 0.015,
                    "contact": law,
                },
            }
            for i, law in enumerate(laws)
        },
        "start": {
            "velocities": {f"journal{i}": [SPEED, 0.0] for i in range(len(laws))},
            "joints": {
                f"bearing{i}": {"eccentricity": [i * APART, 0.0], "rate": [SPEED, 0.0]}
                for i in range(len(laws))
            },
        },
    }


def admitted(law: dict[str, Any]) -> Scene:
    """Return the scene of a journal thrown at a bearing with a law, as it is admitted."""
    return admit({"kind": "simulate", "scene": thrown(law), "duration": 1e-3}).scene
