"""Decompositions, solutions and bounds of our own, against LAPACK's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.elimination import solve, solve_many
from jointplay.solver.linear_algebra.many import least_squares, smallest
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.principal_directions import along_principal_directions
from jointplay.solver.linear_algebra.products import product
from jointplay.solver.linear_algebra.spectral_radius import spectral_radius

TOLERANCE = 1e-9
sizes = st.integers(1, 12)
seeds = st.integers(0, 2**32)


def of_rank(generator: np.random.Generator, rows: int, columns: int, rank: int) -> Floats:
    """Return a matrix whose singular values lie between 1e-3 and 1, and some entries are 0."""
    left, _ = np.linalg.qr(generator.standard_normal((rows, rank)))
    right, _ = np.linalg.qr(generator.standard_normal((columns, rank)))
    found = (left * np.logspace(0.0, -3.0, rank)) @ right.T
    return np.block([[found, np.zeros((rows, 1))], [np.zeros((1, columns)), np.zeros((1, 1))]])


@given(sizes, sizes, sizes, seeds)
def test_least_squares_and_what_is_free_are_those_of_any_rank(
    rows: int, columns: int, rank: int, seed: int
) -> None:
    generator, rank = np.random.default_rng(seed), min(rank, rows, columns)
    matrix, right = of_rank(generator, rows, columns, rank), generator.standard_normal(rows + 1)
    found = Decomposition(matrix, TOLERANCE)
    assert found.rank == rank
    expected, *_ = np.linalg.lstsq(matrix, right, rcond=TOLERANCE)
    assert found.least_squares(right) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert found.inverse() == pytest.approx(np.linalg.pinv(matrix, TOLERANCE), rel=1e-9, abs=1e-9)
    free = found.free
    assert free.shape == (columns + 1, columns + 1 - rank)
    assert np.abs(matrix @ free).max(initial=0.0) < 1e-14
    assert free.T @ free == pytest.approx(np.eye(free.shape[1]), abs=1e-14)


@pytest.mark.parametrize(("share", "rank"), [(1e-8, 3), (1e-10, 2)])
def test_a_rank_is_that_at_the_tolerance(share: float, rank: int) -> None:
    generator = np.random.default_rng(4)
    matrix = generator.standard_normal((5, 3))
    matrix[:, 2] = matrix[:, 0] - matrix[:, 1] + share * matrix[:, 2]
    assert Decomposition(matrix, TOLERANCE).rank == rank
    assert Decomposition(matrix, 0.0, least=1e-9).rank == rank


@pytest.mark.parametrize("shape", [(0, 3), (3, 0), (2, 3)])
def test_nothing_is_asked_of_what_has_no_rank(shape: tuple[int, int]) -> None:
    found = Decomposition(np.zeros(shape), TOLERANCE)
    assert found.rank == 0
    assert (found.least_squares(np.ones(shape[0])) == 0.0).all()
    assert (found.free == np.eye(shape[1])).all()


@given(sizes, st.integers(1, 4), seeds)
def test_many_systems_are_solved_each_as_if_it_were_alone(n: int, count: int, seed: int) -> None:
    generator = np.random.default_rng(seed)
    square, right = generator.standard_normal((count, n, n)), generator.standard_normal((count, n))
    tall, wide = generator.standard_normal((count, n + 3, n)), right
    there = generator.standard_normal((count, n + 3))
    solved, least = solve(square, right), least_squares(tall, there)
    short = smallest(tall, wide)
    for i in range(count):
        size = np.linalg.cond(square[i]) * 1e-13
        assert solved[i] == pytest.approx(np.linalg.solve(square[i], right[i]), rel=size, abs=size)
        size = np.linalg.cond(tall[i]) ** 2 * 1e-13
        near, *_ = np.linalg.lstsq(tall[i], there[i])
        assert least[i] == pytest.approx(near, rel=size, abs=size)
        near, *_ = np.linalg.lstsq(tall[i].T, wide[i])
        assert short[i] == pytest.approx(near, rel=size, abs=size)
        assert (solve(square[i], right[i]) == solved[i]).all()
        assert (least_squares(tall[i], there[i]) == least[i]).all()
        assert (smallest(tall[i], wide[i]) == short[i]).all()


def test_singular_matrices_are_refused() -> None:
    flat = np.array([[[2.0, 1.0], [1.0, 1.0]], [[1.0, 2.0], [2.0, 4.0]]])
    with pytest.raises(np.linalg.LinAlgError):
        solve_many(flat, np.eye(2)[None].repeat(2, axis=0))
    with pytest.raises(np.linalg.LinAlgError):
        least_squares(np.array([[1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]), np.ones(3))


@given(sizes, seeds)
def test_the_spectral_radius_is_bounded_from_above_and_nearly(n: int, seed: int) -> None:
    matrix = np.random.default_rng(seed).standard_normal((n, n))
    radius = float(np.abs(np.linalg.eigvals(matrix)).max())
    found = spectral_radius(matrix, 10)
    assert radius * (1.0 - 1e-9) <= found <= radius * 1.1
    assert spectral_radius(np.triu(matrix, 1), 4) == 0.0  # nilpotent


@given(st.integers(2, 8), seeds)
def test_points_are_seen_along_the_directions_in_which_they_spread_most(
    dimensions: int, seed: int
) -> None:
    generator = np.random.default_rng(seed)
    turned, _ = np.linalg.qr(generator.standard_normal((dimensions, dimensions)))
    points = generator.standard_normal((50, dimensions)) * 0.1 ** np.arange(dimensions) @ turned
    points -= points.mean(axis=0)
    left, sizes, _ = np.linalg.svd(points, full_matrices=False)
    for k, along in enumerate(along_principal_directions(points, 2)):
        assert abs(along @ left[:, k]) == pytest.approx(sizes[k], rel=1e-9)
    flat = along_principal_directions(np.outer(np.arange(5.0) - 2.0, np.ones(dimensions)), 2)
    assert np.abs(flat[1]).max() < 1e-14


@given(sizes, sizes, sizes, seeds)
def test_products_are_those_of_matrices(rows: int, inner: int, columns: int, seed: int) -> None:
    generator = np.random.default_rng(seed)
    first = generator.standard_normal((2, rows, inner))
    second = generator.standard_normal((2, inner, columns))
    assert product(first, second) == pytest.approx(first @ second, abs=1e-13)
