"""Eigenvalues of our own, against LAPACK's and those that are known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.eigenvalues import eigenvalues


def apart(found: list[complex], known: list[complex]) -> float:
    """Return the largest distance of partners."""
    left, worst = list(known), 0.0
    assert len(found) == len(known)
    for one in found:
        nearest = min(left, key=lambda other: abs(other - one))
        left.remove(nearest)
        worst = max(worst, abs(nearest - one))
    return worst


@given(size=st.integers(1, 16), seed=st.integers(0, 2**32), decades=st.sampled_from([0.0, 4.0]))
def test_eigenvalues_are_those_of_lapack_whatever_the_units(
    size: int, seed: int, decades: float
) -> None:
    generator = np.random.default_rng(seed)
    units = 10.0 ** generator.uniform(-decades, decades, size)
    matrix = generator.standard_normal((size, size)) * units[:, None] / units
    known = np.linalg.eigvals(matrix).tolist()
    assert apart(eigenvalues(matrix), known) < 1e-6 * max(map(abs, known))


def turning(size: int) -> list[complex]:
    angles = [2.0 * math.pi * k / size for k in range(size)]
    return [complex(math.cos(angle), math.sin(angle)) for angle in angles]


@pytest.mark.parametrize(
    ("matrix", "known"),
    [
        (np.zeros((3, 3)), [0.0, 0.0, 0.0]),
        (np.eye(4), [1.0, 1.0, 1.0, 1.0]),
        (np.array([[0.0, 1.0], [-1.0, 0.0]]), [1j, -1j]),
        (np.diag([1.0, 1.0, 1.0], 1), [0.0, 0.0, 0.0, 0.0]),
        (np.array([[2.0, 0.0], [1e9, -3.0]]), [2.0, -3.0]),
        # without a shift of another kind the method would go round for ever
        *((np.roll(np.eye(size), 1, axis=0), turning(size)) for size in (3, 4, 5, 8)),
    ],
)
def test_eigenvalues_that_are_known(matrix: Floats, known: list[complex]) -> None:
    assert apart(eigenvalues(matrix), known) < 1e-14


def test_a_matrix_that_is_not_finite_has_none() -> None:
    with pytest.raises(LinAlgError, match="not finite"):
        eigenvalues(np.array([[1.0, math.nan], [0.0, 1.0]]))
