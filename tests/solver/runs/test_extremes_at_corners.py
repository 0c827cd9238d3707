"""Extremes where a steep ramp of friction turns a rate around, within a hundredth of a step."""

from typing import Any

import numpy as np

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation

SOUGHT = 1e-6
"""Share of a channel's range to which its extremes are sought."""
JOURNAL = {
    "clearance": 0.000125660957441,
    "bearing_radius": 0.0006203698129098016,
    "velocity_x": 0.07806533250761286,
    "velocity_y": 2.032234958510233,
    "spin": 0.0,
    "position_x": 2.013574690447517e-05,
    "position_y": 2.666443755943718e-05,
    "gravity_y": -9.81,
    "stiffness": 42667211.1999,
    "restitution": 0.473648151595,
    "friction": 0.136514709888,
    "dynamic_velocity": 0.055941664288,
    "static_velocity": 0.0503474978592,
}


DURATION = 0.0006061625991297975
"""s"""


def simulation(output_step: float) -> Simulation:
    job: dict[str, Any] = {"kind": "simulate", "duration": DURATION, "output_step": output_step}
    scene = {"preset": "bouncing-journal", "parameters": JOURNAL}
    admission = admit(job | {"scene": scene, "tolerance": 1.82437e-07, "certificate": False})
    assert isinstance(admission, Admission)
    return Simulation(admission)


def test_no_sample_is_beyond_an_extreme_next_to_a_corner() -> None:
    """The least spin is where friction changes its side; 2e-6 of its range before it was said."""
    run, sampled = simulation(DURATION), simulation(5e-8)  # samples would count as extremes
    for _ in run.slices():
        pass
    samples = np.concatenate([one.samples for one in sampled.slices()])
    names = [channel.name for channel in run.admission.channels]
    peaks = run.summary().peaks
    for name, values in zip(names, samples.T, strict=True):
        # between two samples the spin moves by 2e-8 of its range
        allowed = SOUGHT * np.ptp(values)
        assert peaks[name].minimum - allowed <= values.min(), name
        assert peaks[name].maximum + allowed >= values.max(), name
