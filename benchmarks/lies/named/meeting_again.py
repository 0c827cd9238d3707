"""A claim about a slider that rattles in its guide, and about which all companions agree later."""

from typing import Any

from benchmarks.lies.named.lie import Lie, by_bars

GUIDE: dict[str, Any] = {
    "kind": "simulate",
    "scene": {
        "name": "swung-guide",
        "gravity": [-5.06367770015, -1.12044041178],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "arm": {
                "mass": 1.0,
                "inertia": 0.1,
                "points": {
                    "O": [0.0, 0.0],
                    "guide": [0.204453719375, 0.0],
                    "far": [0.8178148775, 0.0],
                },
            },
            "slider": {
                "mass": 0.119114884189,
                "inertia": 0.0021213805935313282,
                "points": {"centre": [-0.03618673901091262, 0.01911787298818679]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "arm.O"},
            "guide": {
                "type": "prismatic",
                "guide": "arm.guide",
                "slider": "slider.centre",
                "axis": [1.0, -0.251682118794],
                "clearance": {
                    "wall_clearance": 0.0002586430657635683,
                    "length": 0.204453719375,
                    "height": 0.18987792170441575,
                    "contact": {
                        "law": "lankarani-nikravesh",
                        "stiffness": 403409106.681,
                        "restitution": 0.940212649031,
                    },
                    "friction": {
                        "law": "modified-coulomb",
                        "coefficient": 0.12400393663,
                        "dynamic_velocity": 0.00015169913703,
                        "static_velocity": 1.5169913703e-05,
                    },
                },
            },
        },
        "drivers": {
            "motor": {
                "joint": "O",
                "motion": {
                    "type": "sinusoidal",
                    "amplitude": 0.151900434848,
                    "frequency": 74.7239782842,
                },
            }
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "arm.far",
                "second": "slider.centre",
                "stiffness": 575.1139389713804,
                "damping": 0.09731781582228974,
                "free_length": 0.4202002653137119,
            }
        },
        "start": {"guides": {"guide": {"offset": 0.00010850494703486995, "tilt": 0.0}}},
    },
    "duration": 0.07815863510715819,
    "accuracy": "draft",
}

LIES = (
    Lie(
        "a guide behind its horizon",
        "companions that met again were taken to converge",
        lambda: by_bars(GUIDE),
    ),
)
