"""The solver against a program that shares nothing with it but the readable mechanics."""

import numpy as np

from tests.solver.completed_runs import run
from tests.solver.readable_mechanics import preset
from tests.solver.runs.independent_program import IndependentProgram

PARAMETERS = {
    "clearance_A": 2e-4,
    "clearance_B": 4e-4,
    "bearing_radius": 0.008,
    "restitution": 0.9,
    "friction": 0.05,
    "static_velocity": 1e-3,
    "dynamic_velocity": 1e-2,
    "slip_velocity": "as-published",
    "speed": 2.0,
    "speed_crank4": -3.0,
}
"""Stiffness from eq. 9, unequal clearances and speeds, the slip velocity as published."""

END = 0.0125
CHANNELS = ("slider7.x", "slider7.vx", "link2.theta", "link3.theta", "link6.omega")


def test_an_independent_program_finds_the_same_motion_and_onsets() -> None:
    scene = preset("seven-bar-press", **PARAMETERS)
    # impacts of this press last 0.1 ms and more; DOP853 tests events at step ends only
    program = IndependentProgram(scene, 1e-10, 5e-5)
    motion = program.run(END)
    bodies = motion.bodies
    expected = [
        bodies["slider7"].position[0],
        bodies["slider7"].velocity[0],
        bodies["link2"].angle,
        bodies["link3"].angle,
        bodies["link6"].spin,
    ]
    found = run("seven-bar-press", END, parameters=PARAMETERS, tolerance=1e-11, output_step=END)
    # both are good to about 1e-9 (m, rad, and 100 times that in rates) after two impacts
    np.testing.assert_allclose(found.last(*CHANNELS), expected, rtol=0, atol=1e-7)
    assert found.statistics["onsets"] == len(program.onsets) >= 2
    impacts = sorted(found.impacts, key=lambda impact: impact["onset"])
    for impact, onset in zip(impacts, program.onsets, strict=True):
        assert found.admission.joints[impact["joint"]] == onset.joint
        np.testing.assert_allclose(impact["onset"], onset.time, rtol=0, atol=1e-8)
        np.testing.assert_allclose(impact["approach_rate"], onset.rate, rtol=0, atol=1e-6)
