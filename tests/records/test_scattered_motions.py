"""Motions that do not recur are told apart as far as they scatter; attractors over a parameter."""

import numpy as np
import pytest

from jointplay.records.attractor_table import attractor_table
from jointplay.records.attractors import attractors_of
from jointplay.records.motion import CHAOTIC
from jointplay.records.share_error import share_error
from tests.starts_by_hand import study

CHAOS, REST = 3, 4


def chaos(means, sections=100.0, spread=0.5, **fields):
    """Return records of chaotic motions, whose means scatter by spread / sqrt(sections)."""
    means = np.stack([np.zeros(len(means)), means], axis=1)
    spreads = np.full(means.shape, spread)
    zeros = [0] * len(means)
    return study(zeros, means, spreads, verdicts=CHAOS, independent=sections, **fields)


def drawn(centre, count, error=0.05, seed=1):
    return centre + error * np.random.default_rng(seed).standard_normal(count)


def names(source):
    return [(one.name, one.points) for one in attractors_of(source).found]


def test_chaos_whose_means_differ_beyond_their_scatter_is_of_two_attractors():
    source = chaos([*drawn(-1.0, 60), *drawn(1.0, 40, seed=2)])
    assert names(source) == [("chaotic A", 60), ("chaotic B", 40)]


def test_chaos_whose_means_scatter_is_of_one():
    assert names(chaos(drawn(0.0, 2000))) == [("chaotic", 2000)]


def test_a_record_that_may_be_of_either_is_of_none():
    """One has seen half of each; with so few independent sections it may be anywhere."""
    sections = np.array([100.0] * 40 + [2.0])
    source = chaos([*drawn(-1.0, 20), *drawn(1.0, 20, seed=2), 0.0], sections)
    assert names(source) == [
        ("chaotic (not told apart)", 1),
        ("chaotic A", 20),
        ("chaotic B", 20),
    ]
    assert attractors_of(source).labels[-1] == CHAOTIC


def test_means_without_a_scatter_that_is_known_tell_nothing_apart():
    assert names(chaos([-1.0] * 5 + [1.0] * 5, np.nan)) == [("chaotic", 10)]


def test_chaos_of_one_mean_is_told_apart_by_its_spread():
    spreads = np.array([[0.2, 0.2]] * 10 + [[0.8, 0.8]] * 10)
    means = np.zeros((20, 2))
    source = study([0] * 20, means, spreads, verdicts=CHAOS, independent=200.0)
    assert names(source) == [("chaotic A", 10), ("chaotic B", 10)]


def test_places_of_rest_are_told_apart():
    source = study([np.nan] * 3, [[0.5, 0.0], [-0.5, 0.0], [0.5, 0.0]], verdicts=REST)
    assert names(source) == [("equilibrium A", 2), ("equilibrium B", 1)]


def over(values, places, **fields):
    return study([1] * len(places), [[x, 0.0] for x in places], along=values, **fields)


def test_attractors_are_followed_from_value_to_value():
    """Two move; each stays itself though at every value the other is met first."""
    values = [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]
    found = attractors_of(over(values, [-1.0, 1.0, 0.9, -0.9, -0.8, 0.8]))
    assert found.labels[[0, 3, 4]].tolist() == [found.labels[0]] * 3
    assert found.labels[[1, 2, 5]].tolist() == [found.labels[1]] * 3
    assert [one.name for one in found.found] == ["period-1 A", "period-1 B"]


def test_an_attractor_far_from_those_before_is_a_new_one_and_one_may_be_left_out_for_a_while():
    values = [1.0, 1.0, 2.0, 3.0, 3.0]
    found = attractors_of(over(values, [-1.0, 1.0, 0.0, -1.0, 1.0]))
    assert len(set(found.labels[:3].tolist())) == 3
    assert found.labels[3:].tolist() == found.labels[:2].tolist()


def test_half_a_turn_is_no_edge_over_a_parameter():
    found = attractors_of(over([1.0, 2.0, 1.0], [np.pi - 0.05, 0.05 - np.pi, 0.0]))
    assert found.labels[0] == found.labels[1]


def test_shares_are_of_the_points_of_each_value_that_have_ended():
    values = [1.0] * 4 + [2.0] * 4
    source = over(values, [-1.0, 1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0])
    source.status[7] = 0
    found = attractor_table(source)
    assert found["along"] == {
        "parameter": "push",
        "unit": "N m",
        "values": [1.0, 2.0],
        "ended": [4, 3],
    }
    first, second = found["attractors"]
    assert first["shares"] == pytest.approx([1 / 4, 2 / 3])
    assert second["shares"] == pytest.approx([3 / 4, 1 / 3])
    assert first["share_errors"] == [share_error(1, 4), share_error(2, 3)]
    assert (first["row"], first["column"], first["point"]) == (None, None, 0)
    assert found["boundary"] is None


def test_the_share_over_all_values_has_the_error_of_the_starts_that_all_values_have():
    """Three starts end alike at both values: that is three trials, not six."""
    source = over([1.0] * 3 + [2.0] * 3, [-1.0, 1.0, 1.0] * 2)
    source.values[:, 1] = [0.1, 0.2, 0.3] * 2
    first, second = attractors_of(source).found
    assert (first.share, second.share) == (1 / 3, 2 / 3)
    assert first.error == pytest.approx(float(share_error(1, 3)), rel=1e-12)
    assert first.error == second.error


def test_a_value_of_which_nothing_has_ended_has_no_shares():
    source = over([1.0, 2.0], [0.0, 0.0])
    source.status[1] = 0
    (only,) = attractor_table(source)["attractors"]
    assert only["shares"] == [1.0, None]
