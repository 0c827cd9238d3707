"""Charts: what is refused, and how their points are planned."""

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit, parse
from jointplay.solver.runs.study.blocks import MOST_BLOCKS

CHART = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "along": {"parameter": "speed", "values": {"from": 10.0, "to": 40.0, "count": 9}},
    "by": {"parameter": "amplitude", "values": {"from": 1e-3, "to": 2e-2, "count": 7}},
    "settle": 3,
    "record": 4,
}


def across(count, parameter="speed"):
    return {"parameter": parameter, "values": {"from": 10.0, "to": 40.0, "count": count}}


@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"by": across(4)}, "/by/parameter", "Both axes are 'speed'"),
        ({"by": across(4, "weight")}, "/by/parameter", "weight"),
        ({"along": across(0)}, "/along/values/count", "at least 1"),
        ({"along": across(1)}, "/along/values/count", "cannot reach"),
        ({"along": {"parameter": "speed", "values": []}}, "/along/values", "at least 1"),
        (
            {"along": {"parameter": "speed", "values": [9, 8, 9]}},
            "/along/values/2",
            "9 is there twice",
        ),
        ({"settle": "auto", "statistics": ["impacts"]}, "/settle", "not 'auto'"),
        ({"settle": "auto", "channels": ["*.x"]}, "/settle", "not 'auto'"),
        ({"statistics": ["impact"]}, "/statistics/0", "impacts"),
        ({"statistics": ["mean"]}, "/statistics/0", "name them in 'channels'"),
        ({"observables": ["*"]}, "/observables", "no field 'observables'"),
        ({"starts": 2, "continuation": "forward"}, "/starts", "neighbour or from several"),
        ({"starts": 2, "formulation": "lagrange"}, "/formulation", "reduced"),
        ({"starts": 2, "indicators": ["lyapunov"]}, "/indicators", "recurrence"),
        ({"refine": 1, "continuation": "forward"}, "/refine", "none can be left out"),
        ({"refine": 1, "indicators": []}, "/indicators", "where the motion differs"),
        ({"refine": 7}, "/refine", "at most 6"),
        ({"starts": 65}, "/starts", "at most 64"),
        ({"starts": 2, "spread": 0.0}, "/spread", "all the same"),
        ({"spread": 0.1}, "/spread", "no effect without several 'starts'"),
        ({"seed": 4}, "/seed", "no effect without several 'starts'"),
        ({"continuation": "both"}, "/continuation", "backward"),
        (
            {
                "continuation": "forward",
                "along": {"start": "/start/joints/stop/rate/0", "values": [0.0, 0.1]},
            },
            "/along/start",
            "no start of its own",
        ),
    ],
)
def test_a_chart_that_cannot_be_is_refused_at_its_field(changes, pointer, words):
    with pytest.raises(InvalidInput) as refused:
        admit(CHART | changes)
    (problem,) = refused.value.problems
    assert problem.pointer == pointer
    assert words in problem.detail


@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"along": across(4_000_001)}, "/along/values", "the limit is 4000000"),
        ({"along": across(600_000)}, "/by/values", "4200000 points; the limit is 4000000"),
        ({"along": across(1000), "record": 900_000}, "/record", "the limit is 4e+09"),
        ({"along": across(1000), "record": 20_000, "starts": 30}, "/record", "limit is 4e+09"),
    ],
)
def test_what_is_too_large_is_told_with_what_fits(changes, pointer, words):
    by = {"parameter": "amplitude", "values": {"from": 1e-3, "to": 2e-2, "count": 7}}
    with pytest.raises(LimitExceeded) as refused:
        admit(CHART | {"by": by} | changes)
    (problem,) = refused.value.problems
    assert problem.pointer == pointer
    assert words in problem.detail


def test_points_come_coarse_to_fine_and_cover_the_grid():
    study = admit(CHART)
    assert study.shape == (7, 9)
    assert study.parameters == ("amplitude", "speed")
    assert study.values[0].tolist() == [1e-3, 10.0]
    pairs = {tuple(pair) for pair in study.values}
    assert len(pairs) == 63
    assert {y for y, _ in pairs} == set(np.linspace(1e-3, 2e-2, 7))
    assert {x for _, x in pairs} == set(np.linspace(10.0, 40.0, 9))


@pytest.mark.parametrize(
    "rule",
    [
        {},
        {"continuation": "backward"},
        {"starts": 3, "spread": 0.1, "seed": 4},
        {"refine": 2},
    ],
)
def test_a_planned_chart_is_the_one_that_was_admitted(rule):
    asked = {"channels": ["stop.penetration"], "statistics": ["impacts", "mean"]}
    admitted = admit(CHART | asked | rule)
    planned = parse(admitted.job)
    assert planned.digest == admitted.digest
    np.testing.assert_array_equal(planned.values, admitted.values)
    assert planned.blocks == admitted.blocks
    assert planned.shape == admitted.shape
    assert planned.perturbation == admitted.perturbation
    assert (planned.starts, planned.refine) == (admitted.starts, admitted.refine)
    assert len(planned.chain_order) == len(admitted.chain_order)


def test_a_stored_chart_with_a_value_twice_and_no_spread_is_still_planned():
    stored = admit(CHART | {"starts": 2}).job
    stored["along"] = {"parameter": "speed", "values": [9.0, 8.0, 9.0]}
    planned = parse(stored | {"spread": 0.0})
    assert planned.shape == (7, 3)
    assert planned.perturbation.spread == 0.0


@pytest.mark.parametrize("rule", [{}, {"refine": 3}])
def test_a_large_chart_has_few_blocks_and_no_python_object_a_point(rule):
    study = admit(CHART | {"along": across(60_000)} | rule)
    assert study.points == 420_000
    assert len(study.blocks) <= MOST_BLOCKS
    assert sum(count for _, count in study.blocks) == study.points
    assert not isinstance(study.chain_order, tuple)
    assert study.chain_order[1234] == (1234,)
