"""Symmetric systems in scalars: solutions against NumPy's, zeros that stay, divisions."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.mechanics.elimination import is_zero, solve_semidefinite, solve_symmetric
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.readable_mechanics import preset

ROUNDING = 1e-12
"""A hundred times the rounding of elimination with the condition numbers below, 50 at most."""


@st.composite
def systems(draw: st.DrawFn) -> tuple[dict[tuple[int, int], float], list[list[float]]]:
    """Draw matrices with dominant diagonals and zeros anywhere, and right-hand sides with zeros."""
    n = draw(st.integers(1, 6))
    entry = st.one_of(st.just(0.0), st.floats(-1.0, 1.0))
    matrix = {(i, j): draw(entry) for i in range(n) for j in range(i)}
    matrix |= {(i, i): n + draw(st.floats(0.5, 2.0)) for i in range(n)}
    rights = draw(st.lists(st.lists(entry, min_size=n, max_size=n), min_size=1, max_size=3))
    return matrix, rights


@given(systems())
def test_solutions_are_those_of_an_independent_program(
    system: tuple[dict[tuple[int, int], float], list[list[float]]],
) -> None:
    matrix, rights = system
    full = np.zeros((len(rights[0]),) * 2)
    for (i, j), value in matrix.items():
        full[i, j] = full[j, i] = value
    expected = np.linalg.solve(full, np.array(rights).T).T
    np.testing.assert_allclose(solve_symmetric(matrix, rights), expected, 0.0, ROUNDING)
    kinds = ["length"] * len(full)
    np.testing.assert_allclose(
        solve_semidefinite(matrix, rights[0], kinds), expected[0], 0.0, ROUNDING
    )


def test_an_unknown_that_nothing_moves_stays_an_exact_zero() -> None:
    matrix = {(0, 0): 2.0, (1, 1): 3.0, (1, 0): 1.0, (2, 2): 1.0, (3, 3): 4.0, (3, 2): 0.5}
    [x] = solve_symmetric(matrix, [[1.0, 2.0, 0.0, 0.0]])
    assert [is_zero(one) for one in x] == [False, False, True, True]


@pytest.mark.parametrize("name", ["seven-bar-press", "slider-crank", "double-pendulum"])
def test_no_division_of_the_mass_matrix_waits_for_another(name: str) -> None:
    scene = preset(name)
    equations = trace(scene, spanning_tree(scene), "reduced")

    @cache
    def divisions(node: Expression) -> int:
        """Return how many divisions of variable numbers wait for one another before this."""
        own = node.operation == "div" and not node.fixed
        return max(map(divisions, node.arguments), default=0) + own

    assert max(map(divisions, equations.accelerations)) == 1
