"""Chains and blocks: every point once, lanes filled, and never a look at the workers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.runs.study.blocks import (
    chained_blocks,
    chains_of,
    independent_blocks,
    segments,
)
from tests.solver.runs.study.jobs_of_studies import BIFURCATION, study

DIRECTIONS = st.sampled_from(["forward", "backward", "both"])


@given(st.integers(1, 5000))
def test_independent_blocks_are_octets_up_to_64_and_alike(points: int) -> None:
    blocks = independent_blocks(points)
    assert covered(blocks) == list(range(points))
    sizes = [count for _, count in blocks]
    assert all(size % 8 == 0 and size <= 64 for size in sizes[:-1])
    octets = [-(-size // 8) for size in sizes]
    assert octets == sorted(octets, reverse=True)
    assert octets[0] - octets[-1] <= 1
    assert sizes[-1] <= 64


def covered(blocks: tuple[tuple[int, int], ...]) -> list[int]:
    return [point for first, count in blocks for point in range(first, first + count)]


def test_small_studies_have_about_eight_blocks() -> None:
    assert [len(independent_blocks(n)) for n in (1, 8, 9, 64, 200, 512, 1000)] == [
        1,
        1,
        2,
        8,
        8,
        8,
        16,
    ]


@given(st.integers(1, 500), st.integers(1, 200))
def test_segments_are_contiguous_and_of_like_length(values: int, count: int) -> None:
    found = segments(values, count)
    assert [value for segment in found for value in segment] == list(range(values))
    lengths = {len(segment) for segment in found}
    assert max(lengths) - min(lengths) <= 1
    assert len(found) == min(count, values)


@given(st.integers(1, 300), DIRECTIONS, st.integers(1, 40))
def test_chains_and_their_blocks_hold_every_point_once(
    values: int, direction: str, count: int
) -> None:
    chains = chains_of(values, direction, count)
    points = sorted(point for chain in chains for point in chain)
    total = values * (2 if direction == "both" else 1)
    assert points == list(range(total))
    blocks = chained_blocks(chains, values)
    assert covered(blocks) == list(range(total))
    for chain in chains:  # no chain spans blocks, no block mixes directions
        assert sum(first <= min(chain) and max(chain) < first + n for first, n in blocks) == 1
    for first, n in blocks:
        own = [chain for chain in chains if first <= chain[0] < first + n]
        assert len(own) <= 8
        assert first // values == (first + n - 1) // values


def test_a_chain_goes_from_neighbour_to_neighbour_in_its_direction() -> None:
    forward = study(BIFURCATION, values=[*range(1, 7)], parameter="speed", continuation="forward")
    assert forward.chain_order == ((0,), (1,), (2,), (3,), (4,), (5,))
    both = study(
        BIFURCATION,
        values=[1.0, 2.0, 3.0, 4.0, 5.0],
        parameter="speed",
        continuation="both",
        chains=2,
    )
    assert both.chain_order == ((0, 1, 2), (3, 4), (7, 6, 5), (9, 8))
    assert both.chain_of.tolist() == [0, 0, 0, 1, 1, 2, 2, 2, 3, 3]
    assert both.blocks == ((0, 5), (5, 5))
    assert both.values[:, 0].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0] * 2
    assert both.point_scene(8) == both.point_scene(3)
    strict = study(
        BIFURCATION, values=[1.0, 2.0, 3.0], parameter="speed", continuation="backward", chains=1
    )
    assert strict.chain_order == ((2, 1, 0),)


def test_without_continuation_every_point_is_its_own_chain() -> None:
    found = study(BIFURCATION)
    assert list(found.chain_order) == [(0,), (1,), (2,)]
    assert found.chain_of.tolist() == [0, 1, 2]


@pytest.mark.parametrize("points", [100_000])
def test_the_largest_study_is_cut_up(points: int) -> None:
    assert len(independent_blocks(points)) == 1563
