"""Rows of Morris' design."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.morris import LEVELS, STEP


def morris(rows: int, parameters: int, seed: int) -> Floats:
    """Return rows in which each parameter moves once, by `STEP`, in an order that is drawn."""
    generator = np.random.Generator(np.random.Philox(seed))
    start = (generator.integers(0, LEVELS, (rows, 1, parameters)) + 0.5) / LEVELS
    order = generator.permuted(np.tile(np.arange(parameters), (rows, 1)), axis=1)
    moved = order[:, None, :] < np.arange(parameters + 1)[:, None]
    return np.asarray(start + np.where(start < 0.5, STEP, -STEP) * moved, np.float64)
