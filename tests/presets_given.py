"""Presets with what must be given of them, and those whose kernels take long to compile."""

from collections.abc import Iterable
from typing import Any

import pytest

from jointplay.solver.scene import presets

REQUIRED: dict[str, dict[str, float]] = {
    "seven-bar-test-bed": {
        "pivot_distance": 0.318,
        "pivot_angle": -0.705,
        "phase": 3.0,
        "speed_crank1": 6.283185307179586,
        "speed_crank4": -6.283185307179586,
    }
}
COMPILED_AT_LENGTH = {
    "seven-bar-press-fitted",  # as the press but for the exponent and the slip velocity
    "seven-bar-press-punching",  # as the press but for a force
    "seven-bar-test-bed",  # nearly as the press
    "four-bar",  # as the slider-crank
    "quick-return",  # its guide that turns is tested with the mechanics of sliders
    "n-four-bar",  # as the double four-bar, but longer
    "double-pendulum",
    "driven-pendulum",
    "andrews-squeezer",
    "double-four-bar",
    "jansen-leg",
}
"""Their kernels take a minute together, and show little that those of the others do not."""


def given(name: str) -> dict[str, Any]:
    """Return a preset as a job names it, with values for what it requires."""
    return {"preset": name, "parameters": dict(REQUIRED.get(name, {}))}


def compiled() -> Iterable[Any]:
    """Return the names of all presets for a test that compiles each one's kernels."""
    return [
        pytest.param(name, marks=pytest.mark.long) if name in COMPILED_AT_LENGTH else name
        for name in presets.names()
    ]
