"""Rows of Saltelli's design, of a scrambled Sobol' sequence."""

import numpy as np

from jointplay.records.arrays import Floats

SMALLEST = 2.0**-31
"""Half of what two numbers of the sequence differ by."""


def saltelli(rows: int, parameters: int, seed: int) -> Floats:
    """Return A, B, and A with one parameter after the other of B; `rows` is a power of two."""
    from scipy.stats.qmc import Sobol  # loads 60 MB, which nothing else needs

    drawn = Sobol(2 * parameters, scramble=True, bits=30, rng=seed).random(rows)
    drawn = np.clip(drawn, SMALLEST, 1.0 - SMALLEST)
    a, b = drawn[:, None, :parameters], drawn[:, None, parameters:]
    return np.concatenate([a, b, np.where(np.eye(parameters, dtype=bool), b, a)], axis=1)
