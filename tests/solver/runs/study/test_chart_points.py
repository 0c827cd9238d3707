"""Points of charts: the bits of a diagram's, whatever the block, and what is kept of them."""

import numpy as np
import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.runs.study import blocks
from jointplay.solver.runs.study.run import StudyRun

SPEEDS = [16.0, 19.3, 24.0, 31.0, 36.0]
SHARED = {
    "scene": {"preset": "impact-oscillator", "parameters": {"amplitude": 0.005}},
    "settle": 6,
    "record": 6,
    "tolerance": 1e-6,
    "indicators": ["lyapunov", "recurrence"],
}
CHART = SHARED | {
    "kind": "chart",
    "along": {"parameter": "speed", "values": SPEEDS},
    "by": {"parameter": "amplitude", "values": [0.004, 0.005]},
    "statistics": ["impacts"],
    "channels": ["stop.penetration"],
}


def computed(document):
    """Return the ends of a study's points by their values, and its numbers of rows."""
    study = admit(document)
    ends, rows = {}, 0
    for block in range(len(study.blocks)):
        for piece in StudyRun(study, block).slices():
            rows += len(piece.rows)
            for end in piece.ended:
                ends[tuple(study.values[end.point])] = end
    return ends, rows


@pytest.fixture(scope="module")
def chart():
    return computed(CHART)


def test_a_point_has_the_indicators_of_a_diagram_bit_for_bit(chart):
    diagram, _ = computed(SHARED | {"kind": "bifurcation", "parameter": "speed", "values": SPEEDS})
    ends, _ = chart
    assert len(ends) == 10
    for (speed,), end in diagram.items():
        found = ends[0.005, speed]
        assert found.indicators == end.indicators
        assert found.statistics["steps"] == end.statistics["steps"]


def test_a_rectangle_of_a_chart_has_its_bits_in_other_blocks(chart, monkeypatch):
    monkeypatch.setattr(blocks, "BLOCKS", 1)
    part = CHART | {"along": {"parameter": "speed", "values": SPEEDS[1:4]}}
    ends, _ = computed(part)
    for place, end in ends.items():
        whole = chart[0][place]
        assert whole.indicators == end.indicators
        assert whole.statistics == end.statistics
        assert whole.peaks.tobytes() == end.peaks.tobytes()


def test_a_point_keeps_what_was_asked_for_and_no_sections(chart):
    ends, rows = chart
    assert rows == 0
    for end in ends.values():
        assert set(end.statistics) == {"steps", "onsets", "stop.impacts"}
        assert set(end.indicators) == {"verdict", "period", "lyapunov", "lyapunov_error"}
        assert end.reason == ""


def test_impacts_and_extremes_are_those_after_settling(chart):
    sweep, _ = computed(
        {
            "kind": "sweep",
            "scene": SHARED["scene"],
            "grid": {"speed": SPEEDS},
            "periods": 12,
            "settle": 6,
            "tolerance": 1e-6,
            "statistics": ["impacts"],
            "channels": ["stop.penetration"],
        }
    )
    for (speed,), end in sweep.items():
        found = chart[0][0.005, speed]
        assert found.statistics["stop.impacts"] == end.statistics["stop.impacts"]
        # the carried tangent takes no part in steps: the same run, the same extremes
        np.testing.assert_array_equal(found.peaks, end.peaks)
