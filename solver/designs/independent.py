"""Independent rows: what shares of them are counted of has binomial errors."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.designs.saltelli import SMALLEST


def independent(rows: int, parameters: int, seed: int) -> Floats:
    """Return points of which each is drawn by itself; of more rows the first ones are the same.

    They come from the counter-based generator Philox (Salmon et al. 2011) keyed by the seed.
    """
    generator = np.random.Generator(np.random.Philox(key=np.array([seed, 0], np.uint64)))
    drawn = generator.random((rows, parameters))
    return np.clip(drawn, SMALLEST, 1.0 - SMALLEST)[:, None, :]
