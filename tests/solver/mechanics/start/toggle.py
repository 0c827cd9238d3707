"""A toggle press: a crank of 40 mm, links of 200 and 220 mm, play in the knee and at the ram."""

from typing import Any

TOGGLE: dict[str, Any] = {
    "name": "toggle-press",
    "ground": {"points": {"O": [-0.35, 0.2], "P": [0.0, 0.4], "G": [0.0, 0.0]}},
    "bodies": {
        "crank": {"mass": 3.0, "inertia": 0.004, "points": {"O": [0, 0], "A": [0.04, 0]}},
        "rod": {"mass": 1.5, "inertia": 0.0113, "points": {"A": [-0.15, 0], "K": [0.15, 0]}},
        "upper": {"mass": 2.0, "inertia": 0.0067, "points": {"P": [-0.1, 0], "K": [0.1, 0]}},
        "lower": {"mass": 2.2, "inertia": 0.0089, "points": {"K": [-0.11, 0], "S": [0.11, 0]}},
        "ram": {"mass": 8.0, "inertia": 0.02, "points": {"S": [0, 0.05], "nose": [0, -0.05]}},
    },
    "joints": {
        "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
        "A": {"type": "revolute", "bearing": "crank.A", "journal": "rod.A"},
        "P": {"type": "revolute", "bearing": "ground.P", "journal": "upper.P"},
        "K": {
            "type": "revolute",
            "bearing": "upper.K",
            "journal": "lower.K",
            "clearance": {
                "radial_clearance": 0.0001,
                "bearing_radius": 0.015,
                "contact": {"law": "lankarani-nikravesh", "restitution": 0.8},
                "friction": {"law": "modified-coulomb", "coefficient": 0.05},
            },
        },
        "R": {"type": "revolute", "bearing": "upper.K", "journal": "rod.K"},
        "S": {
            "type": "revolute",
            "bearing": "ram.S",
            "journal": "lower.S",
            "clearance": {
                "radial_clearance": 0.0001,
                "bearing_radius": 0.015,
                "contact": {"law": "lankarani-nikravesh", "restitution": 0.8},
                "friction": {"law": "modified-coulomb", "coefficient": 0.05},
            },
        },
        "guide": {"type": "prismatic", "guide": "ground.G", "slider": "ram.nose", "axis": [0, 1]},
    },
    "drivers": {"motor": {"joint": "O", "position": 1.5708, "speed": 12.566}},
    "gravity": [0, -9.81],
}
