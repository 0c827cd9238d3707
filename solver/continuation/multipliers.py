"""Multipliers of periodic orbits, and functions of them that vanish where orbits bifurcate."""

import math
from collections.abc import Iterable
from itertools import combinations

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.eigenvalues import eigenvalues
from jointplay.solver.linear_algebra.elimination import solve

CRITICAL = {"LP": 1.0, "PD": -1.0}
"""Multipliers of special orbits, by their label."""
Complexes = np.ndarray[tuple[int], np.dtype[np.complex128]]


def multipliers_of(jacobian: Floats) -> Complexes:
    """Return (size,) eigenvalues of a section map's Jacobian, the largest first.

    Of a pair of complex ones that with the positive imaginary part comes first.
    """
    order = sorted(eigenvalues(jacobian), key=lambda one: (-round(size(one), 12), -one.imag))
    return np.array(order, np.complex128)


def size(multiplier: complex) -> float:
    """Return the distance of a multiplier from zero."""
    return math.sqrt(multiplier.real * multiplier.real + multiplier.imag * multiplier.imag)


def largest(multipliers: Complexes) -> float:
    """Return the largest distance of a multiplier from zero."""
    return max(map(size, multipliers.tolist()))


def unstable(multipliers: Complexes, label: str = "", *, within: float = 0.0) -> int:
    """Return how many multipliers lie outside of the unit circle, by more than a distance.

    `label` : of a special orbit; the multiplier or the pair that makes it one is not counted.
    """
    left = multipliers.tolist()
    if label == "NS":
        left = neutral_pair(multipliers)[1].tolist()
    elif label in CRITICAL:
        left.remove(min(left, key=lambda one: size(one - CRITICAL[label])))
    return sum(size(one) > 1.0 + within for one in left)


def doubling(multipliers: Complexes) -> float:
    """Return a number that changes its sign where a real multiplier passes -1."""
    return _product((one.real + 1.0, one.imag) for one in multipliers.tolist())


def passing_one(multipliers: Complexes) -> float:
    """Return a number that changes its sign where a real multiplier passes 1."""
    return _product((one.real - 1.0, one.imag) for one in multipliers.tolist())


def torus(multipliers: Complexes) -> float:
    """Return a number that changes its sign where the product of two multipliers passes 1."""
    return _product(_less_one(*pair) for pair in combinations(multipliers.tolist(), 2))


def _less_one(one: complex, other: complex) -> tuple[float, float]:
    """Return the product of two less one, real and imaginary."""
    real = one.real * other.real - one.imag * other.imag
    return real - 1.0, one.real * other.imag + one.imag * other.real


def _product(factors: Iterable[tuple[float, float]]) -> float:
    """Return the real part of a product; numpy's has other last bits on other processors."""
    real, imaginary = 1.0, 0.0
    for x, y in factors:
        real, imaginary = real * x - imaginary * y, real * y + imaginary * x
    return real


def is_torus(multipliers: Complexes) -> bool:
    """Return whether the pair whose product is nearest to 1 is complex: else they are real."""
    return bool(multipliers[_neutral(multipliers)[0]].imag != 0.0)


def preserves_areas(multipliers: Complexes, within: float) -> bool:
    """Return whether the product of two multipliers is 1 but for an error of each."""
    one, other = (size(multipliers[k]) for k in _neutral(multipliers))
    return abs(one * other - 1.0) <= within * (one + other)


def neutral_pair(multipliers: Complexes) -> tuple[float, Complexes]:
    """Return half the sum of the two whose product is nearest to 1, and the other multipliers.

    Of a pair on the unit circle that is the cosine of its angle.
    """
    pair = list(_neutral(multipliers))
    first, second = multipliers[pair].tolist()
    return 0.5 * (first.real + second.real), np.delete(multipliers, pair)


def _neutral(multipliers: Complexes) -> tuple[int, int]:
    """Return the places of the two multipliers whose product is nearest to 1."""
    left = multipliers.tolist()
    pairs = combinations(range(len(left)), 2)
    return min(pairs, key=lambda pair: size(complex(*_less_one(left[pair[0]], left[pair[1]]))))


def spread(one: Complexes, other: Complexes) -> float:
    """Return how far apart two sets of multipliers are: of the largest distance to a partner."""
    left = other.tolist()
    worst = 0.0
    for value in one.tolist():
        nearest = min(left, key=lambda partner: size(partner - value))
        left.remove(nearest)
        worst = max(worst, size(nearest - value))
    return worst if math.isfinite(worst) else math.inf


def direction_of(jacobian: Floats, multiplier: float) -> Floats:
    """Return the direction, of length 1, in which a real multiplier stretches; by iteration."""
    count = len(jacobian)
    shifted = jacobian - (multiplier + 1e-7) * np.eye(count)
    found: Floats = 1.0 / np.arange(1.5, count + 1.0)
    for _ in range(4):
        found = solve(shifted, found)
        found = found / math.sqrt(float(np.sum(found * found)))
    return np.asarray(found, np.float64)
