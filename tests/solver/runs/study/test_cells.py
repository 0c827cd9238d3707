"""Cells of a map that is refined, of labels that are known at once."""

import numpy as np
import pytest

from jointplay.records.coarse_to_fine import coarse_points, refined, tiles
from jointplay.solver.runs.study.blocks import MOST_BLOCKS, refined_blocks
from jointplay.solver.runs.study.cells import decided

SHAPE = (75, 130)
DEPTH = 3


def disc(shape=SHAPE, centre=(31.3, 64.2), radius=21.7):
    y, x = np.indices(shape)
    return np.hypot(y - centre[0], x - centre[1]) < radius


def filled_in(labels, origins):
    """Return labels as cells tell them, indices that counted, and indices that were looked at."""
    shape, flat = labels.shape, labels.ravel()
    known = set()

    def differ(corners):
        return np.array([len(set(flat[cell].tolist())) > 1 for cell in corners])

    while True:
        found = decided(np.array(origins), shape, DEPTH, known.__contains__, differ)
        if not found.missing:
            break
        assert known.isdisjoint(found.missing)
        known |= set(found.missing)
    table = np.full(labels.size, -1)
    for index in found.computed:
        table[index] = flat[index]
    for index, origin in found.inherited.items():
        assert table[index] == -1
        table[index] = flat[origin]
    return table, found.computed, known


def coarse(shape):
    order = refined(shape, DEPTH)
    return order[: coarse_points(shape, DEPTH)]


def test_a_boundary_is_found_to_the_point_and_little_else_is_computed():
    labels = disc()
    origins = coarse(SHAPE)
    table, computed, known = filled_in(labels, origins)
    table[origins] = labels.ravel()[origins]
    np.testing.assert_array_equal(table.reshape(SHAPE), labels)
    assert 4 * 21.7 < len(computed) < 0.1 * labels.size
    assert len(known) < 0.15 * labels.size
    # every point whose neighbour has the other label counts by itself, or is of the coarse grid
    edge = labels[:, 1:] != labels[:, :-1]
    beside = {int(y) * SHAPE[1] + int(x) for y, x in zip(*np.nonzero(edge), strict=True)}
    assert beside <= computed | set(origins.tolist())


def test_each_tile_alone_finds_what_the_whole_map_has():
    labels = disc(centre=(60.0, 66.0))  # over the corner of four tiles
    whole, _, _ = filled_in(labels, coarse(SHAPE))
    origins = coarse(SHAPE)
    table = np.full(labels.size, -1)
    for tile in np.unique(tiles(origins, SHAPE)):
        part, _, _ = filled_in(labels, origins[tiles(origins, SHAPE) == tile])
        assert not ((table >= 0) & (part >= 0)).any()
        table = np.maximum(table, part)
    np.testing.assert_array_equal(table, whole)


@pytest.mark.parametrize("shape", [(1, 1), (1, 40), (9, 8), SHAPE])
def test_every_point_is_computed_inherits_or_is_of_the_coarse_grid(shape):
    labels = np.random.default_rng(3).random(shape) < 0.03
    table, _, _ = filled_in(labels, coarse(shape))
    assert np.count_nonzero(table == -1) == len(coarse(shape))
    assert (table[coarse(shape)] == -1).all()


def test_corners_of_a_cell_are_the_next_origins_or_the_last_points_of_the_map():
    def missing(origin):
        cells = decided(np.array([origin]), SHAPE, DEPTH, lambda _: False, lambda _: np.zeros(0))
        return [divmod(index, SHAPE[1]) for index in cells.missing]

    assert missing(0) == [(0, 0), (0, 8), (8, 0), (8, 8)]
    assert missing(72 * SHAPE[1] + 128) == [(72, 128), (72, 129), (74, 128), (74, 129)]


def test_alike_corners_hide_what_lies_between_them():
    labels = np.zeros(SHAPE, np.bool_)
    labels[19, 19] = True
    table, computed, _ = filled_in(labels, coarse(SHAPE))
    assert not computed
    assert table.max() == 0


@pytest.mark.parametrize(("shape", "depth"), [(SHAPE, 3), ((64, 64), 6), ((3, 5), 3), ((1, 1), 2)])
def test_blocks_are_the_coarse_grid_and_then_whole_tiles(shape, depth):
    blocks, order = refined_blocks(shape, depth), refined(shape, depth)
    assert sorted(order.tolist()) == list(range(shape[0] * shape[1]))
    ends = np.cumsum([count for _, count in blocks])
    assert [first for first, _ in blocks] == [0, *ends[:-1]]
    assert ends[-1] == len(order)
    count = coarse_points(shape, depth)
    assert count in (*ends, 0)
    grid = np.zeros(shape, np.bool_)
    grid[:: 1 << depth, :: 1 << depth] = True
    assert set(order[:count].tolist()) == set(np.flatnonzero(grid).tolist())
    own = [set(tiles(order[first : first + n], shape).tolist()) for first, n in blocks]
    of_tiles = [
        tile for (first, _), ids in zip(blocks, own, strict=True) if first >= count for tile in ids
    ]
    assert len(of_tiles) == len(set(of_tiles))


def test_blocks_of_a_large_map_are_no_more_than_others_have():
    assert len(refined_blocks((2, 400_000), 1)) <= 2 * MOST_BLOCKS
