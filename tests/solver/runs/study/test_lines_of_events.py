"""The strongest line of sections at events, which follow one another at times of their own."""

import math
from typing import Any

import pytest

from tests.solver.runs.study.test_run import Computed

FREE, DRIVEN = 20.0, 28.0
"""rad/s: of the mass on its spring, and of the crank that shakes it."""
GAP = 0.06
"""m from the middle to the stop, which the mass does not reach: it begins 0.01 m from there."""
SECTIONS = 128
POINT: dict[str, Any] = {
    "kind": "poincare",
    "scene": {
        "preset": "impact-oscillator",
        "parameters": {"speed": DRIVEN, "damping": 1e-9, "gap": GAP, "amplitude": 4e-3},
    },
    "settle": 0,
    "record": SECTIONS,
    "indicators": ["spectrum"],
    "tolerance": 1e-9,
}
EVENT = {"channel": "mass.x", "value": -GAP, "direction": "up"}


@pytest.mark.parametrize("section", [{"crank_angle": 0.0}, EVENT])
def test_a_sum_of_two_motions_beats_with_their_difference(section: dict[str, Any]) -> None:
    """The free motion, which is larger, passes the middle; the other comes and goes in between."""
    found = Computed(POINT | {"section": section}).ends[0]
    rate = SECTIONS / found.time  # sections a second
    beat = (DRIVEN - FREE) / (2.0 * math.pi)
    # a line is at the nearest of the frequencies, which are this far apart
    assert found.statistics["onsets"] == 0.0
    assert found.indicators["line_frequency"] == pytest.approx(beat, abs=rate / SECTIONS)
