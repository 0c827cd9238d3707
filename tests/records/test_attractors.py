"""Attractors are told apart by their cycles, and boundaries by how rough they are."""

import numpy as np
import pytest

from jointplay.records.attractor_table import attractor_table
from jointplay.records.attractors import attractors_of
from jointplay.records.basin_boundary import boundary_dimension
from jointplay.records.coarse_to_fine import coarse_to_fine
from jointplay.records.motion import CHAOTIC, FAILED, NAMES, UNDECIDED
from jointplay.records.point import PointStatus
from jointplay.records.share_error import share_error
from tests.starts_by_hand import study


def test_cycles_of_one_period_are_told_apart_by_where_they_are():
    found = attractors_of(study([1, 1, 1, 2], [[0.0, 0.0], [0.5, 0.0], [1e-6, 0.0], [0.0, 0.0]]))
    assert [one.name for one in found.found] == ["period-1 A", "period-1 B", "period-2"]
    first = len(NAMES)
    assert found.labels.tolist() == [first, first + 1, first, first + 2]


def test_mirror_images_are_two_attractors():
    """Their even features are the same; the means of their sections differ in sign."""
    found = attractors_of(study([2, 2], [[0.3, 0.1], [-0.3, -0.1]], [[0.2, 0.2], [0.2, 0.2]]))
    assert [one.name for one in found.found] == ["period-2 A", "period-2 B"]


def test_cycles_of_one_mean_are_told_apart_by_their_spread():
    found = attractors_of(study([2, 2], [[0.0, 0.0]] * 2, [[0.2, 0.0], [0.3, 0.0]]))
    assert len(found.found) == 2


def test_whole_turns_of_an_angle_do_not_count_and_half_a_turn_is_no_edge():
    found = attractors_of(study([1, 1, 1], [[0.5, 0.0], [0.5 + 2 * np.pi, 0.0], [1.0, 0.0]]))
    assert [one.points for one in found.found] == [2, 1]
    edge = attractors_of(study([1, 1], [[np.pi - 1e-6, 0.0], [1e-6 - np.pi, 0.0]]))
    assert [one.points for one in edge.found] == [2]


def test_what_does_not_recur_is_told_by_its_verdict_and_failures_are_counted():
    found = attractors_of(
        study([0, 0, 1], [[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]], verdicts=[3, 3, 1])
    )
    assert [(one.name, one.points) for one in found.found] == [("chaotic", 2), ("period-1", 1)]
    assert found.labels[0] == CHAOTIC
    failed = attractors_of(study([np.nan], [[np.nan, np.nan]], status=PointStatus.failed))
    assert [(one.code, one.name) for one in failed.found] == [(FAILED, "failed")]


def test_shares_have_errors_and_points_that_wait_do_not_count():
    one = study([1] * 4, [[0.0, 0.0], [0.5, 0.0], [0.0, 0.0], [0.0, 0.0]])
    one.status[3] = PointStatus.waiting
    first, second = attractors_of(one).found
    assert (first.share, second.share) == (2 / 3, 1 / 3)
    assert first.error == second.error == share_error(2, 3)


def test_further_attractors_than_have_labels_share_the_last():
    means = [[k, 0.0] for k in np.linspace(-3.0, 3.0, 230)]
    found = attractors_of(study([1] * 230, means))
    assert found.labels.max() == len(NAMES) + 200
    assert found.found[-1].name == "others"
    assert sum(one.points for one in found.found) == 230


def test_the_table_names_a_point_of_each_attractor_where_it_lies():
    means = np.where(np.arange(12)[:, None] % 4 == 3, 0.5, 0.0) * [1.0, 0.0]
    table = attractor_table(study([1] * 12, means[coarse_to_fine((3, 4))], grid=(3, 4)))
    assert [one["points"] for one in table["attractors"]] == [9, 3]
    assert table["attractors"][1]["column"] == 3
    assert table["attractors"][1]["mean"] == {"rod.theta": 0.5, "rod.theta_rate": 0.0}
    assert table["boundary"] is None


def cantor(count, depth):
    """Return which of `count` cells of a line are to the left of an odd number of Cantor's gaps."""
    x = (np.arange(count) + 0.5) / count
    inside = np.zeros(count, np.int64)
    for level in range(1, depth + 1):
        digit = np.floor(x * 3.0**level) % 3
        gap = (digit == 1) & (inside == 0)
        inside[gap] = level
    return inside % 2


def test_a_line_between_basins_has_the_dimension_one():
    y, x = np.mgrid[0:512, 0:512]
    labels = np.where(x + 0.3 * y > 300.5, 5, 6).astype(np.uint8)
    found = boundary_dimension(labels)
    assert found is not None
    assert abs(found.value - 1.0) < max(3.0 * found.error, 0.03)


@pytest.mark.parametrize(("points", "radius", "count"), [(400, 0.05, 20), (400, 0.02, 60)])
def test_edges_of_many_small_discs_have_the_dimension_one(points, radius, count):
    """Also where the distance of neighbours is as long as a disc, or as one is from the next."""
    y, x = (np.mgrid[0:points, 0:points] + 0.5) / points
    for seed in range(5):
        centres = np.random.default_rng(seed).random((count, 2))
        away = np.min([np.hypot(x - one, y - other) for one, other in centres], axis=0)
        found = boundary_dimension(np.where(away < radius, 5, 6).astype(np.uint8))
        assert found is not None
        assert abs(found.value - 1.0) < 2.0 * found.error
        assert found.error < 0.25


def test_stripes_as_wide_as_the_least_distances_tell_no_dimension():
    y, x = np.mgrid[0:50, 0:50]
    labels = np.where(np.sin(0.75 * x + 0.1 * y) > 0.0, 5, 6).astype(np.uint8)
    assert boundary_dimension(labels) is None


def test_lines_over_a_cantor_set_have_its_dimension_and_one():
    """The exact dimension is 1 + ln 2 / ln 3; that of a grid is biased by less than 0.1."""
    labels = np.broadcast_to(5 + cantor(3**6, 6), (729, 729)).astype(np.uint8)
    found = boundary_dimension(labels)
    assert found is not None
    assert found.value == pytest.approx(1.0 + np.log(2.0) / np.log(3.0), abs=0.1)
    assert found.error < 0.1


@pytest.mark.parametrize("code", [FAILED, UNDECIDED])
def test_what_failed_or_is_undecided_bounds_no_basin(code):
    labels = np.full((64, 64), 5, np.uint8)
    labels[:, 32:] = code
    assert boundary_dimension(labels) is None


@pytest.mark.parametrize("code", [FAILED, UNDECIDED])
def test_a_line_has_the_dimension_one_whatever_is_undecided_beside_it(code):
    labels = np.full((256, 256), 6, np.uint8)
    labels[:, 128:] = 7
    labels[np.random.default_rng(0).random(labels.shape) < 0.03] = code
    found = boundary_dimension(labels)
    assert found is not None
    assert abs(found.value - 1.0) < 0.05
