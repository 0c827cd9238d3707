"""Charts that are refined: bits of the whole chart where they compute, and who inherits."""

import numpy as np
import pytest

from jointplay.solver.computations import computation_of
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study import blocks
from tests.solver.runs.study.test_drives_out_of_step import ROOT, TURN, shaken

RANGE = ("from", "to", "count")
WHOLE = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "settle": 20,
    "record": 6,
    "tolerance": 1e-5,
    "indicators": ["recurrence"],
    "statistics": ["impacts"],
    "along": {"parameter": "speed", "values": dict(zip(RANGE, (24.0, 40.0, 67), strict=True))},
    "by": {"parameter": "amplitude", "values": dict(zip(RANGE, (2e-3, 9e-3, 13), strict=True))},
}
CHART = WHOLE | {"refine": 2}


def computed(document, break_after=None):
    """Return what points have by their values; every so many slices a restart point is used."""
    study = admit(document)
    ends = {}
    for block, (first, count) in enumerate(study.blocks):
        run, slices = computation_of(study, block), 0
        pieces = run.slices()
        while (piece := next(pieces, None)) is not None:
            assert all(first <= point < first + count for point in piece.started)
            for end in piece.ended:
                assert first <= end.point < first + count
                place = tuple(study.values[end.point])
                assert place not in ends
                ends[place] = end.code, dict(end.indicators), dict(end.statistics)
            slices += 1
            if break_after and slices % break_after == 0:
                run = computation_of(study, block, run.checkpoint())
                pieces = run.slices()
    assert len(ends) == study.points
    return ends


@pytest.fixture(scope="module")
def chart():
    return computed(CHART)


@pytest.fixture(scope="module")
def whole():
    return computed(WHOLE)


def inherits(found):
    return found[2]["inherited"] == 1.0


def test_computed_points_have_the_bits_of_the_whole_chart(chart, whole):
    own = {place: found for place, found in chart.items() if not inherits(found)}
    assert len(chart) / 16 < len(own) < len(chart) / 2
    for place, (code, indicators, statistics) in own.items():
        assert (code, indicators, statistics) == (
            *whole[place][:2],
            whole[place][2] | {"inherited": 0.0},
        )


def test_inherited_points_have_all_of_an_origin_but_its_steps(chart):
    y, x = (np.unique([place[k] for place in chart]) for k in (0, 1))
    for (at_y, at_x), (code, indicators, statistics) in chart.items():
        row, column = np.searchsorted(y, at_y), np.searchsorted(x, at_x)
        if not statistics["inherited"]:
            continue
        sides = (4, 2)
        origins = [chart[y[row // s * s], x[column // s * s]] for s in sides]
        assert any(
            not inherits(one)
            and (one[0], one[1]) == (code, indicators)
            and one[2] | {"steps": 0.0, "inherited": 1.0} == statistics
            for one in origins
        )


def test_labels_are_those_of_the_whole_chart_nearly_everywhere(chart, whole):
    same = [chart[place][1].get("period") == whole[place][1].get("period") for place in chart]
    struck = [
        (chart[place][2]["stop.impacts"] > 0) == (whole[place][2]["stop.impacts"] > 0)
        for place in chart
    ]
    assert np.mean(same) > 0.97
    assert np.mean(struck) > 0.97


@pytest.mark.parametrize("every", [1, 5])
def test_a_refined_chart_that_is_interrupted_has_the_same_bits(chart, every):
    assert computed(CHART, break_after=every) == chart


def test_other_blocks_give_the_same_bits(chart, monkeypatch):
    monkeypatch.setattr(blocks, "MOST_BLOCKS", 1)  # both tiles together
    assert len(admit(CHART).blocks) == 2
    assert computed(CHART) == chart


def test_a_rectangle_alone_has_the_bits_of_the_chart_in_its_cells(chart):
    """It begins with a cell; at its far edges a cell ends sooner."""
    x, y = np.linspace(24.0, 40.0, 67)[12:45], np.linspace(2e-3, 9e-3, 13)[4:]
    part = computed(
        CHART
        | {"along": {"parameter": "speed", "values": x.tolist()}}
        | {"by": {"parameter": "amplitude", "values": y.tolist()}}
    )
    inside = {place: found for place, found in part.items() if place[1] < x[32] and place[0] < y[8]}
    assert len(inside) == 8 * 32
    assert inside == {place: chart[place] for place in inside}


def test_what_drives_without_a_common_period_carry_along_splits_no_cell():
    """A linear oscillator moves alike everywhere; its exponent is minus half the damping."""
    ranges = {"damping": (0.2, 0.4, 9), "stiffness": (2.0, 4.0, 9)}
    parameters = {
        name: {"help": name, "unit": unit, "default": 0.3}
        | {"targets": [{"path": f"/forces/spring/{name}", "factor": 1.0}]}
        for name, unit in (("damping", "N s/m"), ("stiffness", "N/m"))
    }
    along, by = (
        {"parameter": name, "values": dict(zip(RANGE, values, strict=True))}
        for name, values in ranges.items()
    )
    scene = shaken(1.0, ROOT, period=TURN) | {"parameters": parameters}
    job = {"kind": "chart", "scene": scene, "along": along, "by": by, "refine": 2}
    found = computed(job | {"settle": 5, "record": 16})
    exponents = {place[1]: one[1]["lyapunov"] for place, one in found.items() if not inherits(one)}
    assert sum(not inherits(one) for one in found.values()) == 9
    for damping, exponent in exponents.items():
        assert exponent == pytest.approx(-0.5 * damping, rel=0.05)
