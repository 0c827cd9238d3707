"""Ranges of the press that are known from independent programs, and printed by the publication."""

import math
from typing import cast

import pytest

from jointplay.paper import reported
from jointplay.paper.variants import CONSTANT, MATERIAL, Variant
from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.study.run import StudyRun

SPEEDS = (math.pi, 2.5 * math.pi)


@pytest.fixture(scope="module")
def ranges() -> list[tuple[float, float]]:
    """Ranges of the eccentricity of A in x [m] at both speeds, 0.5 mm, friction 0.1, K = 5e9."""
    parameters = Variant(CONSTANT, MATERIAL).parameters | {"clearance": 5e-4, "friction": 0.1}
    job = {
        "kind": "sweep",
        "scene": {"preset": reported.document()["scene"], "parameters": parameters},
        "grid": {"speed": list(SPEEDS)},
        "settle": 20,
        "periods": 40,
        "channels": ["A.eccentricity_x"],
    }
    study = cast("Study", admit(job))
    ends = [end for part in StudyRun(study, 0).slices() for end in part.ended]
    ends.sort(key=lambda end: end.point)
    assert [end.code for end in ends] == ["", ""]
    return [(float(end.peaks[0, 0]), float(end.peaks[0, 2])) for end in ends]


def test_at_the_slow_speed_a_stays_on_one_side_of_its_bearing(ranges):
    low, high = ranges[0]
    # the lower end still creeps inwards while the motion settles: 3.83e-4 to 3.87e-4 m
    assert low == pytest.approx(3.85e-4, rel=0.01)
    # clearance and penetration, which hardly depends on the bounces
    assert high == pytest.approx(5.03e-4, rel=2e-3)


def test_at_the_fast_speed_a_crosses_its_bearing(ranges):
    # the deepest penetration is that of the strongest impact in the window
    assert ranges[1] == pytest.approx((-5.1e-4, 5.1e-4), rel=0.02)


@pytest.mark.parametrize("index", [0, 1], ids=["slow", "fast"])
def test_the_printed_ranges_are_near(ranges, index):
    (entry,) = [
        one
        for one in reported.document()["phase_ranges"]
        if reported.parameters(one)["clearance"] == 5e-4
        and reported.parameters(one)["speed"] == pytest.approx(SPEEDS[index], rel=1e-12)
    ]
    # their contact parameters are not known: a hundredth of the width of the clearance
    assert ranges[index] == pytest.approx(entry["A"]["x"], abs=1e-5)
