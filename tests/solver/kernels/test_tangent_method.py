"""The method of tangent vectors: its order, and what it makes of what swings and what decays."""

import numpy as np

from jointplay.solver.kernels.emit.tangent_method import COUPLING, NODES, STAGES, WEIGHTS

A = np.array([[*weights, *[0.0] * (STAGES - len(weights))] for weights in COUPLING])
B, C = np.array(WEIGHTS), np.array(NODES)


def grown(z: complex) -> float:
    """Return by how much a step of x' = λ x multiplies |x|, z = λ h."""
    return abs(1.0 + z * (B @ np.linalg.solve(np.eye(STAGES) - z * A, np.ones(STAGES))))


def test_the_method_is_of_order_four() -> None:
    # Butcher's conditions
    found = [B.sum(), B @ C, B @ C**2, B @ A @ C]
    found += [B @ C**3, B @ (C * (A @ C)), B @ A @ C**2, B @ A @ A @ C]
    np.testing.assert_allclose(
        found, [1, 1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24], rtol=1e-12
    )


def test_oscillations_keep_their_amplitude_where_they_are_followed_and_die_where_not() -> None:
    assert 0.9998 < grown(0.75j) < 1.0
    assert all(0.97 < grown(1j * y) < 1.0 for y in np.linspace(0.1, 1.8, 50))
    assert all(grown(1j * y) < 1.0 for y in np.linspace(1.8, 3.7, 50))


def test_what_decays_dies_however_fast() -> None:
    assert all(grown(-x) < max(1.1 * np.exp(-x), 0.15) for x in np.linspace(0.0, 5.0, 100))
    assert all(grown(-x) < 0.95 for x in np.linspace(5.0, 6.4, 50))
