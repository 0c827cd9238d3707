"""Starts that are drawn: which they are, in which order, and what is refused."""

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit, parse

ECCENTRICITY = "/start/joints/stop/eccentricity/0"
RATE = "/start/joints/stop/rate/0"
PHASE = "/drivers/motor/position"


def uniform(low, high):
    return {"distribution": "uniform", "low": low, "high": high}


def job(starts=None, **fields):
    return {
        "kind": "basin-stability",
        "scene": {"preset": "impact-oscillator"},
        "starts": starts or {ECCENTRICITY: uniform(0.17, 0.2), PHASE: uniform(0.0, 6.0)},
        "samples": 50,
        "settle": 5,
        "record": 6,
        "indicators": ["recurrence"],
    } | fields


def problems(document, refusal=InvalidInput):
    with pytest.raises(refusal) as refused:
        admit(document)
    return [(one.pointer, one.detail) for one in refused.value.problems]


def test_starts_are_drawn_by_their_seed_and_more_samples_go_on():
    few, many, other = (
        admit(job(**fields)).values for fields in ({}, {"samples": 80}, {"seed": 1})
    )
    assert few.shape == (50, 2)
    assert np.array_equal(many[:50], few)
    assert not (other == few).any()
    assert ((few[:, 0] > 0.17) & (few[:, 0] < 0.2)).all()


def test_the_numbers_of_a_seed_stay_what_they_are():
    """Results are repeated by their job: the generator's stream is part of the format."""
    drawn = np.random.Generator(np.random.Philox(key=np.array([7, 0], np.uint64))).random((50, 2))
    found = admit(job(seed=7)).values
    assert found[:, 1] == pytest.approx(6.0 * drawn[:, 1], rel=1e-12)


def test_the_same_starts_are_there_at_each_value_and_every_value_fills_in_alike():
    study = admit(job(along={"parameter": "speed", "values": [25.0, 26.0, 28.0]}))
    assert study.parameters == ("speed", "stop.eccentricity_x", "motor.position")
    table = study.values.reshape(50, 3, 3)
    assert table[:, :, 0].tolist() == [[25.0, 26.0, 28.0]] * 50
    assert np.array_equal(table[:, 0, 1:], table[:, 2, 1:])
    assert np.array_equal(table[:, 0, 1:], admit(job()).values)
    assert study.point_scene(4).drivers["motor"].speed == 26.0
    assert study.point_scene(4).start.joints["stop"].eccentricity[0] == table[1, 1, 1]
    assert parse(study.job).digest == study.digest


def test_any_distribution_may_be_drawn():
    normal = {"distribution": "normal", "mean": 0.0, "standard_deviation": 0.1}
    found = admit(job({RATE: normal}, samples=2000)).values[:, 0]
    assert found.std() == pytest.approx(0.1, rel=0.1)


@pytest.mark.parametrize(
    ("fields", "pointer", "words"),
    [
        ({"starts": {"/start/joints/stopp/rate/0": uniform(0, 1)}}, "~1rate~10", "'stopp'"),
        ({"starts": {"/bodies/mass/mass": uniform(0, 1)}}, "/starts/~1bodies~1mass~1mass", "start"),
        ({"starts": {RATE: uniform(1.0, 0.0)}}, "/starts/~1start~1joints~1stop~1rate~10/", "low"),
        ({"starts": {}}, "/starts", "at least 1"),
        ({"along": {"parameter": "sped", "values": [1.0]}}, "/along/parameter", "'speed'"),
        ({"along": {"start": RATE, "values": [1.0]}}, "/along", "parameter"),
        ({"by": {"parameter": "speed", "values": [1.0]}}, "/by", "no field 'by'"),
        ({"indicators": ["lyapunov"]}, "/indicators", "recurrence"),
        ({"formulation": "lagrange"}, "/formulation", "reduced"),
    ],
)
def test_what_cannot_be_drawn_is_refused_where_it_stands(fields, pointer, words):
    found = problems(job() | fields)
    assert any(pointer in at and words in detail for at, detail in found), found


def test_too_many_starts_are_refused_before_they_are_drawn():
    along = {"parameter": "speed", "values": {"from": 20.0, "to": 30.0, "count": 1000}}
    ((pointer, detail),) = problems(job(samples=5000, along=along), LimitExceeded)
    assert pointer == "/samples"
    assert "5000000 points" in detail


def test_a_value_is_refused_that_would_count_its_starts_twice():
    (found,) = problems(job(along={"parameter": "speed", "values": [28.0, 25.0, 28.0]}))
    sentence = "28 is there twice, and its starts would count twice; drop one."
    assert found == ("/along/values/2", sentence)
