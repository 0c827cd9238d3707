"""Rows of Saltelli's design, of a scrambled Sobol' sequence."""

import math

import numpy as np

from jointplay.records.arrays import Floats

SMALLEST = 2.0**-31
"""Half of what two numbers of the sequence differ by."""
ORDERS = 200
"""Orders of the sequence's columns that are tried."""
SCATTER = 1.2
"""Standard deviation of `_dependence` of independent numbers, times the root of the rows, about."""


def saltelli(rows: int, parameters: int, seed: int) -> Floats:
    """Return A, B, and A with one parameter after the other of B; `rows` is a power of two."""
    from scipy.stats.qmc import Sobol  # loads 60 MB, which nothing else needs

    drawn = Sobol(2 * parameters, scramble=True, bits=30, rng=seed).random(rows)
    drawn = np.clip(_apart(drawn, seed), SMALLEST, 1.0 - SMALLEST)
    a, b = drawn[:, None, :parameters], drawn[:, None, parameters:]
    return np.concatenate([a, b, np.where(np.eye(parameters, dtype=bool), b, a)], axis=1)


def _apart(drawn: Floats, seed: int) -> Floats:
    """Return the columns in an order in which none depends on the one half of them behind it.

    Two columns of few rows may lie on a few lines (Joe and Kuo 2008, SIAM Journal on Scientific
    Computing 30:2635). If they are one parameter's numbers in A and B, its indices are wrong by
    more than those of independent numbers, and resamples of rows do not show it.

    drawn : (rows, 2 parameters).
    """
    rows, columns = drawn.shape
    generator = np.random.default_rng([seed, 1])
    order = np.arange(columns)
    best, least = order, math.inf
    for _ in range(ORDERS):
        dependence = _dependence(drawn, order)
        if dependence < least:
            best, least = order, dependence
        if least * math.sqrt(rows) < SCATTER:
            break
        order = generator.permutation(columns)
    return np.asarray(drawn[:, best], np.float64)


def _dependence(drawn: Floats, order: np.ndarray[tuple[int], np.dtype[np.int64]]) -> float:
    """Return by how much the variance of one parameter's numbers in A and B differs, at most.

    Half the mean square of their difference is the variance, of the numbers and of their squares
    about the middle, if they do not depend on each other.
    """
    a, b = np.split(order, 2)
    about = drawn - 0.5
    found = 0.0
    for numbers, variance in ((about, 1.0 / 12.0), (about * about, 1.0 / 180.0)):
        squares = ((numbers[:, a] - numbers[:, b]) ** 2).mean(axis=0)
        found = max(found, float(np.abs(squares / (2.0 * variance) - 1.0).max()))
    return found
