"""Rows of a Latin hypercube."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.designs.saltelli import SMALLEST


def latin_hypercube(rows: int, parameters: int, seed: int) -> Floats:
    """Return one point in each of as many equal probabilities of every parameter."""
    from scipy.stats.qmc import LatinHypercube  # loads 60 MB, which nothing else needs

    drawn = LatinHypercube(parameters, rng=seed).random(rows)
    return np.clip(drawn, SMALLEST, 1.0 - SMALLEST)[:, None, :]
