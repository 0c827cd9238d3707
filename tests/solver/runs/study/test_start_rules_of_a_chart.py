"""Charts whose points start from their neighbours, or from several starts each."""

import numpy as np
import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.runs.study import blocks
from jointplay.solver.runs.study.run import StudyRun

SHARED = {
    "scene": {"preset": "impact-oscillator"},
    "settle": 30,
    "record": 6,
    "tolerance": 1e-6,
    "indicators": ["recurrence"],
    "statistics": ["impacts"],
}
AMPLITUDES = [0.0045, 0.00475, 0.005]
UP = {"from": 24.0, "to": 34.0, "count": 11}
CHART = SHARED | {
    "kind": "chart",
    "along": {"parameter": "speed", "values": UP},
    "by": {"parameter": "amplitude", "values": AMPLITUDES},
}
THREE = CHART | {"starts": 3, "by": {"parameter": "amplitude", "values": [0.005]}}


def computed(document, break_after=None):
    """Return the ends of a study's points by their values; each slice may resume from a file."""
    study = admit(document)
    ends = {}
    for block in range(len(study.blocks)):
        run, slices = StudyRun(study, block), 0
        pieces = run.slices()
        while (piece := next(pieces, None)) is not None:
            for end in piece.ended:
                assert tuple(study.values[end.point]) not in ends
                ends[tuple(study.values[end.point])] = end
            slices += 1
            if break_after and slices % break_after == 0:
                run = StudyRun(study, block, run.checkpoint())
                pieces = run.slices()
    return ends


def told(ends):
    return {
        place: (end.code, dict(end.indicators), dict(end.statistics)) for place, end in ends.items()
    }


def impacts(ends, amplitude):
    found = {
        speed: end.statistics["stop.impacts"] for (y, speed), end in ends.items() if y == amplitude
    }
    return [found[speed] > 0 for speed in sorted(found)]


@pytest.mark.parametrize("direction", ["forward", "backward"])
def test_each_row_is_a_diagram_of_one_chain_bit_for_bit(direction):
    chart = computed(CHART | {"continuation": direction})
    for amplitude in AMPLITUDES[1:]:
        scene = {"preset": "impact-oscillator", "parameters": {"amplitude": amplitude}}
        diagram = computed(
            {key: value for key, value in SHARED.items() if key != "statistics"}
            | {"kind": "bifurcation", "scene": scene, "parameter": "speed", "values": UP}
            | {"continuation": direction, "chains": 1}
        )
        for (speed,), end in diagram.items():
            assert chart[amplitude, speed].indicators == end.indicators
            assert chart[amplitude, speed].statistics["steps"] == end.statistics["steps"]


def test_impacts_last_further_upwards_than_they_begin_downwards():
    up, down = (computed(CHART | {"continuation": way}) for way in ("forward", "backward"))
    for amplitude in AMPLITUDES:
        longer, shorter = impacts(up, amplitude), impacts(down, amplitude)
        assert longer[0]
        assert shorter[0]
        assert not longer[-1]
        assert sum(longer) > sum(shorter)


def test_rows_have_the_same_bits_alone_in_other_blocks_and_resumed(monkeypatch):
    document = CHART | {"continuation": "backward"}
    whole = told(computed(document))
    assert told(computed(document, break_after=1)) == whole
    monkeypatch.setattr(blocks, "BUNDLE", 2)
    alone = told(computed(document | {"by": CHART["by"] | {"values": AMPLITUDES[1:]}}))
    assert len(alone) == 22
    assert alone == {place: whole[place] for place in alone}


def test_rows_come_coarse_to_fine_and_in_blocks_of_eight():
    count = {"from": 0.003, "to": 0.005, "count": 130}
    study = admit(
        CHART | {"continuation": "forward", "by": {"parameter": "amplitude", "values": count}}
    )
    rows = study.values[::11, 0]
    every = np.linspace(0.003, 0.005, 130)
    assert rows[:3].tolist() == every[[0, 64, 128]].tolist()
    assert rows[3:5].tolist() == every[[32, 96]].tolist()
    assert study.blocks[:2] == ((0, 88), (88, 88))
    assert sum(number for _, number in study.blocks) == study.points == 1430
    assert study.shape == (130, 11)


def test_several_starts_count_the_attractors_that_coexist():
    """At 28 rad/s motions with and without impacts coexist; at 24 all strike, at 34 none does."""
    several = computed(THREE | {"spread": 1.0, "seed": 5, "starts": 6, "settle": 80})
    counts = {speed: end.statistics["attractors"] for (_, speed), end in several.items()}
    assert counts[24.0] == counts[34.0] == 1.0
    assert counts[28.0] == 2.0
    one = computed(THREE | {"starts": 1, "settle": 80})
    for place, end in several.items():
        assert end.indicators == one[place].indicators
        assert end.statistics["stop.impacts"] == one[place].statistics["stop.impacts"]
        assert end.statistics["steps"] > 3 * one[place].statistics["steps"]
        assert "attractors" not in one[place].statistics
        assert set(end.statistics) == {"steps", "onsets", "stop.impacts", "attractors"}


def test_several_starts_have_the_same_bits_resumed_and_in_other_blocks(monkeypatch):
    whole = told(computed(THREE))
    assert told(computed(THREE, break_after=1)) == whole
    monkeypatch.setattr(blocks, "BLOCKS", 1)
    assert told(computed(THREE)) == whole
    other = told(computed(THREE | {"seed": 1}))
    assert {place: steps(one) for place, one in other.items()} != {
        place: steps(one) for place, one in whole.items()
    }


def steps(one):
    return one[2]["steps"]
