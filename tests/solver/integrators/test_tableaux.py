"""Every Runge-Kutta method: its order, its error estimate and its dense output."""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from jointplay.solver.integrators import METHODS
from jointplay.solver.integrators.dormand_prince853 import DORMAND_PRINCE853
from jointplay.solver.integrators.method import Method, Rosenbrock

Floats = NDArray[np.float64]

TABLEAUX = [each for each in METHODS.values() if not isinstance(each, Rosenbrock)]
method = pytest.mark.parametrize("tableau", TABLEAUX, ids=lambda tableau: tableau.name)
embedded = pytest.mark.parametrize(
    "tableau", [each for each in TABLEAUX if each.error], ids=lambda tableau: tableau.name
)

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


def square(tableau: Method) -> Floats:
    matrix = np.zeros((tableau.stages, tableau.stages))
    for row, entries in enumerate(tableau.matrix):
        matrix[row, : len(entries)] = entries
    return matrix


def weighted(tableau: Method, tree: Tree) -> Floats:
    """Return the tree's elementary weight at every stage."""
    value = np.ones(tableau.stages)
    for branch in tree:
        value = value * (square(tableau) @ weighted(tableau, branch))
    return value


def rounding(tableau: Method) -> float:
    """Return what a few roundings of entries printed to 16 digits leave, which cancel to 1."""
    return 16 * 2.0**-53 * max(float(np.abs(square(tableau)).max()), 1.0)


def dense_rounding(tableau: Method) -> float:
    """Return the same for the dense output, whose coefficients cancel as well."""
    return 8 * 2.0**-53 * float(np.abs(np.array(tableau.dense)).sum(axis=1).max())


def dense_weights(tableau: Method, theta: float) -> Floats:
    return np.array([sum(c * theta ** (k + 1) for k, c in enumerate(r)) for r in tableau.dense])


def test_there_are_as_many_rooted_trees_as_there_should_be() -> None:
    assert [len(trees(n)) for n in range(1, 7)] == [1, 1, 2, 4, 9, 20]


@method
def test_the_weights_meet_the_order_conditions(tableau: Method) -> None:
    weights = square(tableau)[-1]
    for order in range(1, tableau.order + 1):
        for tree in trees(order):
            assert weights @ weighted(tableau, tree) == pytest.approx(
                1.0 / density(tree), abs=rounding(tableau)
            )


def first_seen(tableau: Method, weights: tuple[float, ...]) -> int:
    """Return the order of the first condition that an error estimate misses."""
    for order in range(1, tableau.order + 1):
        missed = max(abs(np.array(weights) @ weighted(tableau, tree)) for tree in trees(order))
        if missed > 1e-6:  # less would control nothing
            return order
        assert missed < rounding(tableau)
    raise AssertionError("an estimate that sees no error")


@embedded
def test_the_embedded_error_is_of_its_order(tableau: Method) -> None:
    order = first_seen(tableau, tableau.error)
    if tableau.coarse_error:  # |e|² / |E| where |E| is much the larger
        order = 2 * order - first_seen(tableau, tableau.coarse_error)
    assert order == tableau.error_order


@method
def test_stages_are_consistent_and_the_last_is_the_first_of_the_next_step(
    tableau: Method,
) -> None:
    np.testing.assert_allclose(
        square(tableau).sum(axis=1), tableau.nodes, rtol=0, atol=rounding(tableau)
    )
    assert tableau.nodes[-1] == 1.0
    assert len(tableau.matrix[-1]) == tableau.stages - 1


@method
def test_dense_output_ends_on_the_step(tableau: Method) -> None:
    np.testing.assert_allclose(dense_weights(tableau, 0.0), 0.0)
    weights = square(tableau)[-1]
    np.testing.assert_allclose(
        dense_weights(tableau, 1.0), weights, rtol=0, atol=dense_rounding(tableau)
    )


@method
def test_dense_output_starts_and_ends_with_the_slopes_of_the_step(tableau: Method) -> None:
    first, last = np.eye(tableau.stages)[[0, -1]]
    slope_start = np.array([row[0] for row in tableau.dense])
    slope_end = np.array([sum((k + 1) * c for k, c in enumerate(row)) for row in tableau.dense])
    degree = len(tableau.dense[0])
    np.testing.assert_allclose(slope_start, first, atol=1e-13)
    np.testing.assert_allclose(slope_end, last, atol=degree * dense_rounding(tableau))


@method
@pytest.mark.parametrize("theta", [0.1, 0.37, 0.5, 0.82, 1.0])
def test_dense_output_meets_the_conditions_of_its_order(tableau: Method, theta: float) -> None:
    weights = dense_weights(tableau, theta)
    for order in range(1, tableau.dense_order + 1):
        for tree in trees(order):
            assert weights @ weighted(tableau, tree) == pytest.approx(
                theta**order / density(tree), abs=dense_rounding(tableau)
            )


def slopes_of(tableau: Method, state: Floats, h: float) -> Floats:
    """Return the pendulum's slopes (stages, 2) in one step, straight from the tableau."""
    matrix = square(tableau)
    k = np.zeros((tableau.stages, 2))
    for stage in range(tableau.stages):
        angle, rate = state + h * matrix[stage] @ k
        k[stage] = rate, -math.sin(angle)
    return k


def swing(tableau: Method, end: float, steps: int) -> Floats:
    """Return the pendulum's state after fixed steps from an angle of 1.5."""
    state, h = np.array([1.5, 0.0]), end / steps
    for _ in range(steps):
        state = state + h * square(tableau)[-1] @ slopes_of(tableau, state, h)
    return state


def order_of(sizes: Floats, errors: list[float]) -> float:
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


REFERENCE = DORMAND_PRINCE853
"""In a hundred steps of it the pendulum is known to rounding; its order is tested by itself."""


@method
def test_the_error_falls_with_the_order_of_the_method(tableau: Method) -> None:
    exact = swing(REFERENCE, 3.0, 200)
    # few enough steps that errors stay above rounding, whatever the order
    steps = np.round(40.0 ** (4.0 / tableau.order) * np.array([1.0, 1.5, 2.0, 3.0])).astype(int)
    errors = [float(np.abs(swing(tableau, 3.0, n) - exact).max()) for n in steps]
    # an order less would show as a slope less by one; the next term of the error may add up to
    # one, as the small leading coefficients of an optimised method let it weigh in at coarse steps
    assert tableau.order - 0.3 < order_of(3.0 / steps, errors) < tableau.order + 1.0


@method
def test_the_error_inside_a_step_falls_with_the_order_of_the_dense_output(tableau: Method) -> None:
    start = np.array([1.2, 0.9])
    sizes = np.array([0.15, 0.2, 0.3, 0.4])
    errors = []
    for h in sizes:
        k = slopes_of(tableau, start, h)
        worst = 0.0
        for theta in (0.2, 0.35, 0.65, 0.8):
            exact = start
            for _ in range(40):
                part = theta * h / 40
                exact = exact + part * square(REFERENCE)[-1] @ slopes_of(REFERENCE, exact, part)
            found = start + h * dense_weights(tableau, theta) @ k
            worst = max(worst, float(np.abs(found - exact).max()))
        errors.append(worst)
    assert order_of(sizes, errors) == pytest.approx(tableau.dense_order + 1, abs=0.5)


@embedded
def test_the_estimated_error_falls_with_its_order(tableau: Method) -> None:
    start = np.array([1.2, 0.9])
    sizes = np.array([0.05, 0.1, 0.15, 0.2])
    errors = []
    for h in sizes:
        k = slopes_of(tableau, start, h)
        fine = float(np.linalg.norm(h * np.array(tableau.error) @ k))
        if tableau.coarse_error:
            coarse = float(np.linalg.norm(h * np.array(tableau.coarse_error) @ k))
            fine = fine**2 / math.hypot(fine, 0.1 * coarse)
        errors.append(fine)
    assert order_of(sizes, errors) == pytest.approx(tableau.error_order, abs=0.5)
