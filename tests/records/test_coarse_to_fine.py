"""Maps over two axes: the order of their points, their labels, and pictures of fewer cells."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from jointplay.records import motion
from jointplay.records.coarse_to_fine import TILE, coarse_to_fine, over_axes
from jointplay.records.point import PointStatus
from jointplay.records.pyramid import averaged, filled_in, in_majority

SHAPES = st.tuples(st.integers(1, 90), st.integers(1, 90))


@given(SHAPES)
def test_every_point_comes_once_and_coarser_ones_come_first(shape):
    order = coarse_to_fine(shape)
    assert sorted(order) == list(range(shape[0] * shape[1]))
    y, x = np.divmod(order, shape[1])
    apart = [
        next(k for k in (64, 32, 16, 8, 4, 2, 1) if a % k == b % k == 0)
        for a, b in zip(y, x, strict=False)
    ]
    assert apart == sorted(apart, reverse=True)


def test_a_picture_of_an_eighth_of_the_resolution_stands_after_two_per_cent_of_the_work():
    order = coarse_to_fine((1000, 1000))
    y, x = np.divmod(order[: 125 * 125], 1000)
    assert {*y % 8, *x % 8} == {0}
    assert 0.02 * len(order) >= 125 * 125


def test_points_of_a_tile_are_together_within_their_level():
    shape = (2 * TILE, 2 * TILE)
    y, x = np.divmod(coarse_to_fine(shape), shape[1])
    odd = (y % 2 == 1) | (x % 2 == 1)  # the last level
    tiles = (y[odd] // TILE) * 2 + x[odd] // TILE
    assert (np.diff(tiles) >= 0).all()


@given(SHAPES, st.integers(0, 3))
def test_numbers_in_the_order_of_computing_are_laid_over_both_axes(shape, width):
    order = coarse_to_fine(shape)
    table = np.arange(len(order) * max(width, 1)).reshape(len(order), *([width] if width else []))
    laid = over_axes(table[order], order, shape)
    np.testing.assert_array_equal(laid.reshape(table.shape), table)


def test_a_label_has_the_majority_or_is_mixed():
    p1, p2 = (motion.CHAOTIC + period for period in (1, 2))
    labels = np.array([[p1, p1, p2, p2], [p1, p2, p1, 0], [0, 0, 0, 0]], np.uint8)
    expected = [[p1, p2], [motion.WAITING, motion.WAITING]]
    np.testing.assert_array_equal(in_majority(labels, 2), expected)  # 3 of 4; 2 of 3; none of 0
    halves = np.array([[p1, p2], [p1, p2]], np.uint8)
    assert in_majority(halves, 2).tolist() == [[motion.MIXED]]


@given(arrays(np.float64, (7, 10), elements=st.floats(-1e3, 1e3) | st.just(np.nan)))
def test_values_of_a_cell_are_averaged_over_what_is_known(values):
    found = averaged(values, 4)
    for row in range(2):
        for column in range(3):
            cell = values[4 * row : 4 * row + 4, 4 * column : 4 * column + 4]
            known = cell[np.isfinite(cell)]
            expected = known.mean() if len(known) else np.nan
            np.testing.assert_allclose(found[row, column], expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("computed", [1, 20, 300, 70 * 81])
def test_a_point_that_waits_shows_the_nearest_coarser_one(computed):
    shape = (70, 81)
    known = np.zeros(shape, np.bool_)
    known.flat[coarse_to_fine(shape)[:computed]] = True
    values = np.arange(70.0 * 81.0).reshape(shape)
    found = filled_in(np.where(known, values, np.nan), known)
    for y in range(0, 70, 3):
        for x in range(0, 81, 4):
            ancestors = [(y & -k, x & -k) for k in (1, 2, 4, 8, 16, 32, 64)]
            nearest = next((values[one] for one in ancestors if known[one]), np.nan)
            np.testing.assert_equal(found[y, x], nearest)


def test_a_motion_is_told_by_status_verdict_and_period():
    names = ("undecided", "periodic", "quasi-periodic", "chaotic")
    status = np.array([int(one) for one in PointStatus] + 6 * [int(PointStatus.done)], np.uint8)
    verdict = np.array([np.nan, np.nan, 0.0, np.nan, 1.0, 1.0, 2.0, 3.0, 1.0, 1.0])
    period = np.array([np.nan, np.nan, np.nan, np.nan, 1.0, 3.0, 0.0, 0.0, 5000.0, np.nan])
    found = [motion.name_of(code) for code in motion.motions(status, verdict, period, names)]
    by_status = dict(zip((one.name for one in PointStatus), found[:4], strict=True))
    expected = {"waiting": "waiting", "running": "waiting", "done": "undecided", "failed": "failed"}
    assert by_status == expected
    assert found[4:] == [
        *("period-1", "period-3", "quasi-periodic", "chaotic"),
        *("longer than period-200", "undecided"),
    ]


def test_labels_that_occur_often_have_colours_of_their_own():
    colours = {motion.colour_of(code) for code in (*range(len(motion.NAMES) + 8), motion.MIXED)}
    assert len(colours) == len(motion.NAMES) + 9
    assert all(len(motion.colour_of(code)) == 7 for code in range(256))
