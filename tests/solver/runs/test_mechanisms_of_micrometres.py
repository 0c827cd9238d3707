"""Mechanisms of micrometres and picograms move as large ones do."""

import copy
from typing import Any

import numpy as np

import jointplay
from jointplay.solver.scene import presets

LENGTH, MASS = 2.0**-13, 2.0**-42
"""A part of the small crank, 6 um long, of 70 pg."""
STIFFNESS = 1e9


def crank(length: float, mass: float) -> dict[str, Any]:
    """The slider-crank with all lengths and masses scaled, and forces that give the same motion."""
    document = presets.document("slider-crank")
    scene = {key: copy.deepcopy(document[key]) for key in ("name", "bodies", "joints", "drivers")}
    for body in scene["bodies"].values():
        body["mass"] *= mass
        body["inertia"] *= mass * length**2
        body["points"] = {n: [length * x for x in point] for n, point in body["points"].items()}
    joint = scene["joints"]["P"]
    stiffness = STIFFNESS * mass * length / length**1.5
    joint["clearance"] = {
        "radial_clearance": 5e-4 * length,
        "bearing_radius": 0.01 * length,
        "contact": {
            "law": "stiffness-and-dissipation",
            "stiffness": {"law": "power", "stiffness": stiffness, "exponent": 1.5},
            "dissipation": {"law": "exact", "restitution": 0.8},
        },
    }
    for name in set(scene["joints"]) - {"P"}:
        scene["joints"][name].pop("clearance", None)
    return scene | {"ground": document["ground"]}


def test_a_crank_of_micrometres_and_picograms_moves_like_one_of_decimetres_and_kilograms() -> None:
    large, small = (
        jointplay.run(crank(*sizes), duration=0.012) for sizes in ((1, 1), (LENGTH, MASS))
    )
    force = large.history["P.normal_force"].values
    assert force.max() > 1e3
    assert large.statistics["steps"] == small.statistics["steps"]
    for channel, scale in {
        "slider.x": LENGTH,
        "slider.vx": LENGTH,
        "P.normal_force": MASS * LENGTH,
        "energy.kinetic": MASS * LENGTH**2,
    }.items():
        expected = large.history[channel].values
        found = small.history[channel].values / scale
        assert np.abs(found - expected).max() <= 1e-9 * np.ptp(expected)
    assert small.certificate["converged"] == [[0.0, 0.012]]
