"""Windows at the times of samples have their bits, in any period and where channels jump."""

from typing import Any

import numpy as np
import pytest

import jointplay

TURNED = {
    "type": "piecewise-polynomial",
    "knots": [0.0, 0.01, 0.04],
    "coefficients": [[0.0, 0.0, 300.0], [0.03, 6.0, -500.0, 80000.0 / 9.0]],
    "outside": "periodic",
}
"""Its second derivative jumps 0.01 s after each begin, from 600 to -1000."""


def rotor(play: bool) -> dict[str, Any]:
    """Return a rotor whose drive jumps at every tenth sample, with a pendulum on it or without."""
    scene: dict[str, Any] = {
        "name": "rotor",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rotor": {"mass": 1.0, "inertia": 0.01, "points": {"O": [-0.1, 0.0]}}},
        "joints": {"main": {"type": "revolute", "bearing": "ground.O", "journal": "rotor.O"}},
        "drivers": {"motor": {"joint": "main", "motion": TURNED}},
    }
    if play:
        scene["bodies"]["bob"] = {"mass": 1.0, "inertia": 0.01, "points": {"P": [0.1, 0.0]}}
        scene["joints"]["pin"] = {"type": "revolute", "bearing": "rotor.O", "journal": "bob.P"}
    return scene


@pytest.mark.parametrize(
    ("scene", "duration", "step"),
    [
        ({"preset": "slider-crank", "parameters": {"clearance": 3e-4}}, 0.05, 7e-4),
        ({"preset": "slider-crank", "parameters": {"clearance": 0.0}}, 0.05, 7e-4),
        (rotor(True), 0.2, 1e-3),
        (rotor(False), 0.2, 1e-3),
    ],
    ids=["play", "ideal", "jumps", "ideal, jumps"],
)
def test_a_window_has_the_bits_of_samples(
    scene: dict[str, Any], duration: float, step: float
) -> None:
    document = {"kind": "simulate", "scene": scene, "duration": duration, "output_step": step}
    job = jointplay.run(document | {"certificate": False})
    samples = job.window()
    window = job.window(list(samples.channels), 0.0, duration, step=step)
    count = len(window.time)
    assert np.array_equal(samples.time[:count], np.arange(count) * step)
    assert np.array_equal(samples.time[:count], window.time)
    for name in samples.channels:
        assert np.array_equal(samples[name][:count], window[name]), name
