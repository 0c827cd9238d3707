"""Small calibrations that the tests share."""

import copy
from typing import Any

from jointplay.solver.calibration.calibrate import calibrate
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.calibration.problem import Calibration, admit_calibration
from jointplay.solver.calibration.processes import measures

BOUNCE: dict[str, Any] = {
    "kind": "calibration",
    "scene": {"preset": "bouncing-journal", "parameters": {"friction": 0.0}},
    "parameters": {
        "stiffness": {"minimum": 1e8, "maximum": 1e11, "spacing": "log"},
        "restitution": {"minimum": 0.5, "maximum": 1.0},
    },
    "cases": [
        {
            "parameters": {"clearance": 1e-3},
            "targets": [{"channel": "bearing.normal_force", "to": 0.018, "value": 1000.0}],
        }
    ],
    "search": {"population": 8, "generations": 30},
    "spread": {"generations": 8},
}
"""A disc falls from the bearing's centre: its impact is known in closed form."""


def bounce(**changes: Any) -> dict[str, Any]:
    """Return that calibration with other fields."""
    return {**copy.deepcopy(BOUNCE), **changes}


def computed(document: dict[str, Any] | Calibration, processes: int = 1) -> Outcome:
    """Return what a calibration finds."""
    calibration = document if isinstance(document, Calibration) else admit_calibration(document)
    with measures(calibration, processes) as (fitted, every):
        return calibrate(calibration, fitted, every, lambda done, note: None)
