"""Sums that do not depend on how their terms were cut into pieces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def add_in_order(total: Floats, terms: Floats) -> None:
    """Add (rows, channels) terms to a (channels,) total in place, one row after the other.

    numpy's sums take another order for another number of rows. The rounding of n terms in order is
    at most n * 1e-16 of the sum of their magnitudes.
    """
    total[:] = np.add.accumulate(np.concatenate([total[None], terms]), axis=0)[-1]
