"""Saltelli's design: shares of the variance, alone and with all interactions."""

from typing import ClassVar

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.design import Design, Measure


class Saltelli(Design):
    """Rows of A, B, and for each parameter A with that parameter of B.

    Source: Saltelli et al. 2010, Computer Physics Communications 181:259, the estimators that
    `scipy.stats.sobol_indices` has by default: of the first order theirs, of totals Jansen's.
    """

    measures: ClassVar = {
        "first_order": Measure("share of the variance that the parameter has alone"),
        "total": Measure("share of the variance that the parameter has with all interactions"),
    }

    def width(self, parameters: int) -> int:
        """Return the points of a row."""
        return parameters + 2

    def drawn(self, parameters: int) -> tuple[int, ...]:
        """Return A and B."""
        return (0, 1)

    def moments(self, values: Floats, outputs: Floats) -> Floats:
        """Return sums and squares of A and B, and both products of each parameter."""
        a, b, mixed = outputs[:, :1], outputs[:, 1:2], outputs[:, 2:]
        columns = (a + b, a * a + b * b, b * (mixed - a), (a - mixed) ** 2)
        return np.concatenate(columns, axis=1)

    def measured(self, means: Floats, parameters: int) -> dict[str, Floats]:
        """Return both shares."""
        variance = means[..., 1:2] / 2.0 - (means[..., :1] / 2.0) ** 2
        variance = np.where(variance > 0.0, variance, np.nan)
        alone, apart = means[..., 2 : 2 + parameters], means[..., 2 + parameters :]
        return {"first_order": alone / variance, "total": apart / (2.0 * variance)}
