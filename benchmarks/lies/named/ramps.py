"""Claims about extremes where friction rises from nothing to all within a narrow ramp of slip."""

from benchmarks.lies.named.lie import Lie, by_extremes

HELD = {
    "kind": "simulate",
    "scene": {
        "preset": "slider-crank",
        "parameters": {
            "clearance": 0.000790713,
            "bearing_radius": 0.00325985666,
            "speed": 29.038,
            "stiffness": 38573900.0,
            "restitution": 0.76685,
            "friction": 0.223688,
            "dynamic_velocity": 2.45732e-05,
            "static_velocity": 2.211588e-05,
        },
    },
    "duration": 0.01138274,
    "method": "rodas",
    "tolerance": 1.16974e-07,
}
BEARING = {
    "radial_clearance": 0.00177001114033,
    "bearing_radius": 0.0324108258577,
    "contact": {"law": "lankarani-nikravesh", "stiffness": 247516728.0, "restitution": 0.4838117},
    "friction": {
        "law": "modified-coulomb",
        "coefficient": 0.04492156,
        "dynamic_velocity": 0.0380996748,
        "static_velocity": 0.0342897073,
    },
}
PENDULUM = {
    "name": "loose-pendulum",
    "gravity": [0.0, -9.81],
    "ground": {"points": {"O": [0.0, 0.0]}},
    "bodies": {
        "rod": {
            "mass": 0.570742853139,
            "inertia": 0.0249253021257,
            "points": {"a": [-0.406442105262, 0.0], "b": [0.406442105262, 0.0]},
        }
    },
    "joints": {
        "O": {"type": "revolute", "bearing": "ground.O", "journal": "rod.a", "clearance": BEARING}
    },
    "start": {"angles": {"rod": 0.737645268627}, "angular_velocities": {"rod": 3.84870963313}},
}
SWUNG = {"kind": "simulate", "scene": PENDULUM, "duration": 0.06, "tolerance": 5.88991e-06}
TURNED = {
    "kind": "simulate",
    "scene": {
        "preset": "slider-crank",
        "parameters": {
            "clearance": 6.81913139075e-05,
            "bearing_radius": 0.00020124254418168365,
            "speed": -289.668897073,
            "stiffness": 231532122.866,
            "restitution": 0.514187971749,
            "friction": 0.327670522719,
            "dynamic_velocity": 0.0192045522726,
            "static_velocity": 0.0019204552272600003,
        },
    },
    "duration": 0.007698033179717061,
    "method": "auto",
    "tolerance": 8.94894e-06,
}

LIES = (
    Lie(
        "slider-crank, held by a ramp",
        "slip swayed inside steps that looked smooth at their ends",
        lambda: by_extremes(HELD),
    ),
    Lie(
        "pendulum, a ramp crossed in one step",
        "a force was largest where slip came to the ramp",
        lambda: by_extremes(SWUNG),
    ),
    Lie(
        "slider-crank, a swing that a rise hid",
        "an eccentricity's rate turned while no step was looked into",
        lambda: by_extremes(TURNED),
    ),
)
"""Extremes that were lies once: friction bends inside steps."""
