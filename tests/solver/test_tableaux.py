"""Every Runge-Kutta method: its order, its last stage, its dense output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from solver.integrators import METHODS
from solver.integrators.tableau import Tableau

Floats = NDArray[np.float64]

method = pytest.mark.parametrize("tableau", METHODS.values(), ids=list(METHODS))

ROUNDING = 2e-14
"""Entries of up to 13, printed to 16 digits, cancel to at most 1: a few times 13 * 2^-53."""

Tree = tuple["Tree", ...]


@cache
def trees(order: int) -> tuple[Tree, ...]:
    """Return all rooted trees with that many nodes (Butcher): 1, 1, 2, 4, 9 for orders 1 to 5."""

    def forests(nodes: int, largest: tuple[int, int]) -> Iterator[Tree]:
        if nodes == 0:
            yield ()
            return
        for size in range(min(nodes, largest[0]), 0, -1):
            branches = trees(size)
            last = largest[1] if size == largest[0] else len(branches) - 1
            for i in range(last, -1, -1):
                for rest in forests(nodes - size, (size, i)):
                    yield (branches[i], *rest)

    return tuple(forests(order - 1, (order - 1, len(trees(order - 1)) - 1 if order > 1 else 0)))


def nodes(tree: Tree) -> int:
    return 1 + sum(nodes(branch) for branch in tree)


def density(tree: Tree) -> int:
    """Return γ(t), whose inverse the weighted sum of a tree must be."""
    return nodes(tree) * math.prod(density(branch) for branch in tree)


def square(tableau: Tableau) -> Floats:
    matrix = np.zeros((tableau.stages, tableau.stages))
    for row, entries in enumerate(tableau.matrix):
        matrix[row, : len(entries)] = entries
    return matrix


def weighted(tableau: Tableau, tree: Tree) -> Floats:
    """Return the tree's elementary weight at every stage."""
    value = np.ones(tableau.stages)
    for branch in tree:
        value = value * (square(tableau) @ weighted(tableau, branch))
    return value


def dense_weights(tableau: Tableau, theta: float) -> Floats:
    return np.array([sum(c * theta ** (k + 1) for k, c in enumerate(r)) for r in tableau.dense])


def test_there_are_as_many_rooted_trees_as_there_should_be() -> None:
    assert [len(trees(n)) for n in range(1, 7)] == [1, 1, 2, 4, 9, 20]


@method
def test_the_weights_meet_the_order_conditions(tableau: Tableau) -> None:
    weights = square(tableau)[-1]
    for order in range(1, tableau.order + 1):
        for tree in trees(order):
            assert weights @ weighted(tableau, tree) == pytest.approx(
                1.0 / density(tree), abs=ROUNDING
            )


@method
def test_the_embedded_error_is_of_the_order_below(tableau: Tableau) -> None:
    error = np.array(tableau.error)
    for order in range(1, tableau.error_order):
        for tree in trees(order):
            assert error @ weighted(tableau, tree) == pytest.approx(0.0, abs=ROUNDING)
    worst = max(abs(error @ weighted(tableau, tree)) for tree in trees(tableau.error_order))
    assert worst > 1e-6  # or nothing would be controlled


@method
def test_stages_are_consistent_and_the_last_is_the_first_of_the_next_step(
    tableau: Tableau,
) -> None:
    np.testing.assert_allclose(square(tableau).sum(axis=1), tableau.nodes, rtol=0, atol=ROUNDING)
    assert tableau.nodes[-1] == 1.0
    assert len(tableau.matrix[-1]) == tableau.stages - 1


@method
def test_dense_output_ends_on_the_step(tableau: Tableau) -> None:
    np.testing.assert_allclose(dense_weights(tableau, 0.0), 0.0)
    # coefficients up to 88 cancel at theta = 1
    np.testing.assert_allclose(
        dense_weights(tableau, 1.0), square(tableau)[-1], rtol=0, atol=88 * 2.0**-52 * 4
    )


@method
def test_dense_output_starts_and_ends_with_the_slopes_of_the_step(tableau: Tableau) -> None:
    first = np.zeros(tableau.stages)
    first[0] = 1.0
    last = np.zeros(tableau.stages)
    last[-1] = 1.0
    slope_start = np.array([row[0] for row in tableau.dense])
    slope_end = np.array([sum((k + 1) * c for k, c in enumerate(row)) for row in tableau.dense])
    np.testing.assert_allclose(slope_start, first, atol=1e-13)
    np.testing.assert_allclose(slope_end, last, atol=1e-12)


@method
@pytest.mark.parametrize("theta", [0.1, 0.37, 0.5, 0.82, 1.0])
def test_dense_output_is_of_the_order_below(tableau: Tableau, theta: float) -> None:
    weights = dense_weights(tableau, theta)
    for order in range(1, tableau.order):
        for tree in trees(order):
            assert weights @ weighted(tableau, tree) == pytest.approx(
                theta**order / density(tree), abs=1e-13
            )


def integrate(
    tableau: Tableau, slope: Callable[[Floats], Floats], state: Floats, end: float, steps: int
) -> Floats:
    """Integrate with fixed steps, straight from the tableau."""
    matrix, h = square(tableau), end / steps
    for _ in range(steps):
        k = np.zeros((tableau.stages, len(state)))
        for stage in range(tableau.stages):
            k[stage] = slope(state + h * matrix[stage] @ k)
        state = state + h * matrix[-1] @ k
    return state


@method
def test_halving_the_step_divides_the_error_by_two_to_the_order(tableau: Tableau) -> None:
    def pendulum(y: Floats) -> Floats:
        return np.array([y[1], -math.sin(y[0])])

    start = np.array([1.5, 0.0])
    exact = integrate(tableau, pendulum, start, 3.0, 4000)
    steps = np.array([40, 80, 160, 320])
    errors = [np.abs(integrate(tableau, pendulum, start, 3.0, n) - exact).max() for n in steps]
    slope = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    # an order less would show as a slope of 4; the next term of the error may add up to one,
    # as the small leading coefficients of an optimised method let it weigh in at coarse steps
    assert tableau.order - 0.3 < slope < tableau.order + 1.0
