"""Claims about extremes of bristles: they slide, and swing inside steps at the limit of stability.

One is apart, the other in contact; both steps' ends look smooth.
"""

from typing import Any

from benchmarks.lies.named.lie import Lie, by_extremes
from benchmarks.lies.scenes.bearing import rotor_in_bearing


def _spun(
    duration: float,
    rotor: dict[str, Any],
    clearance: dict[str, Any],
    spin: float,
    start: dict[str, Any],
) -> dict[str, Any]:
    begin = {"angular_velocities": {"rotor": spin}, "joints": {"J": start}}
    scene = rotor_in_bearing("bristled-journal", 0.0, rotor, clearance, begin)
    return {"kind": "simulate", "scene": scene, "duration": duration}


DAHL = _spun(
    0.006381098897386148,
    {
        "mass": 0.0205936497321,
        "inertia": 4.728218354003003e-07,
        "points": {"pin": [0.0027388504592455102, 0.0]},
    },
    {
        "radial_clearance": 2.98370677179e-05,
        "bearing_radius": 0.0054955227417684644,
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": 48316231684.9,
            "restitution": 0.433649872553,
        },
        "friction": {
            "law": "dahl",
            "coefficient": 0.0249906271284,
            "bristle_stiffness": 2080.58690397,
        },
    },
    299.709425589,
    {
        "eccentricity": [2.334963697625918e-05, 7.070227905762754e-06],
        "rate": [0.029932343194922256, -0.0036856051895010297],
    },
) | {"accuracy": "draft"}
LUGRE = _spun(
    0.0006433814866435534,
    {
        "mass": 0.0630923436069,
        "inertia": 0.00013027403658899355,
        "points": {"pin": [0.0007346263212290162, 0.0]},
    },
    {
        "radial_clearance": 0.000825131397741,
        "bearing_radius": 0.024077446909262938,
        "contact": {
            "law": "lankarani-nikravesh",
            "stiffness": 6516375836.98,
            "restitution": 0.401262550061,
        },
        "friction": {
            "law": "lugre",
            "static_coefficient": 0.059338112616849695,
            "kinetic_coefficient": 0.0379720500123,
            "stribeck_velocity": 0.0173319123642,
            "bristle_stiffness": 568.080436935,
            "bristle_damping": 0.187976575757,
            "viscous_damping": 0.00743242797206,
        },
    },
    218.389889857,
    {
        "eccentricity": [0.00017464866584528005, -9.475273124469726e-05],
        "rate": [0.06627951317030188, 0.4632889351291425],
    },
)

LIES = (
    Lie("bristles that slide apart, a draft", "1.4e-4 too low", lambda: by_extremes(DAHL)),
    Lie("bristles that slide in contact", "2.6e-6 too low", lambda: by_extremes(LUGRE)),
)
