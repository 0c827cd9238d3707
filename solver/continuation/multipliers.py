"""Multipliers of periodic orbits, and functions of them that vanish where orbits bifurcate."""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.elimination import solve

Complexes = np.ndarray[tuple[int], np.dtype[np.complex128]]


def multipliers_of(jacobian: Floats) -> Complexes:
    """Return (size,) eigenvalues of a section map's Jacobian, the largest first.

    Of a pair of complex ones that with the positive imaginary part comes first.
    """
    found = np.linalg.eigvals(jacobian).astype(np.complex128)
    order = sorted(found.tolist(), key=lambda one: (-round(abs(one), 12), -one.imag))
    return np.array(order, np.complex128)


def unstable(multipliers: Complexes) -> int:
    """Return how many multipliers lie outside of the unit circle."""
    return int(np.count_nonzero(np.abs(multipliers) > 1.0))


def doubling(multipliers: Complexes) -> float:
    """Return a number that changes its sign where a real multiplier passes -1."""
    return float(np.prod(multipliers + 1.0).real)


def passing_one(multipliers: Complexes) -> float:
    """Return a number that changes its sign where a real multiplier passes 1."""
    return float(np.prod(multipliers - 1.0).real)


def torus(multipliers: Complexes) -> float:
    """Return a number that changes its sign where the product of two multipliers passes 1."""
    rows, columns = np.triu_indices(len(multipliers), 1)
    return float(np.prod(multipliers[rows] * multipliers[columns] - 1.0).real)


def is_torus(multipliers: Complexes) -> bool:
    """Return whether the pair whose product is nearest to 1 is complex: else they are real."""
    rows, columns = np.triu_indices(len(multipliers), 1)
    nearest = int(np.argmin(np.abs(multipliers[rows] * multipliers[columns] - 1.0)))
    return bool(multipliers[rows[nearest]].imag != 0.0)


def spread(one: Complexes, other: Complexes) -> float:
    """Return how far apart two sets of multipliers are: of the largest distance to a partner."""
    left = other.tolist()
    worst = 0.0
    for value in one.tolist():
        nearest = min(left, key=lambda partner: abs(partner - value))
        left.remove(nearest)
        worst = max(worst, abs(nearest - value))
    return worst if math.isfinite(worst) else math.inf


def direction_of(jacobian: Floats, multiplier: float) -> Floats:
    """Return the direction, of length 1, in which a real multiplier stretches; by iteration."""
    size = len(jacobian)
    shifted = jacobian - (multiplier + 1e-7) * np.eye(size)
    found = np.cos(np.arange(size) + 1.0)
    for _ in range(4):
        found = solve(shifted, found)
        found = found / math.sqrt(float(np.sum(found * found)))
    return np.asarray(found, np.float64)
