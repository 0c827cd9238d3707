"""Small calibrations that the tests share."""

import copy
from typing import Any

import numpy as np

from jointplay.solver.calibration.calibrate import calibrate, costs_of
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.calibration.space import Space
from jointplay.solver.kinds import admit_calibration
from jointplay.worker.local.measures import measures

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
        return calibrate(calibration, costs_of(calibration, fitted), every, lambda done, note: None)


def coordinates(space: Space, values: np.ndarray) -> np.ndarray:
    """Return coordinates from 0 to 1 of parameters (n, parameters)."""
    low, high, at = (
        np.where(space.logarithmic, np.log(np.where(space.logarithmic, x, 1.0)), x)
        for x in (space.minimum, space.maximum, values)
    )
    return (at - low) / (high - low)
