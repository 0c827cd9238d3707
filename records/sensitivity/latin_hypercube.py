"""A Latin hypercube: a sample that is even in each parameter, for quantiles and correlations."""

from typing import ClassVar

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.sensitivity.design import Design, Measure


class LatinHypercube(Design):
    """Rows of one point."""

    measures: ClassVar = {
        "rank_correlation": Measure("Spearman's correlation of the output with the parameter"),
    }

    def width(self, parameters: int) -> int:
        """Return the points of a row."""
        return 1

    def drawn(self, parameters: int) -> tuple[int, ...]:
        """Return the point."""
        return (0,)

    def moments(self, values: Floats, outputs: Floats) -> Floats:
        """Return the output's rank and its square, and those of each parameter with the product."""
        output = _ranks(outputs)
        ranks = _ranks(values[:, 0, :])
        return np.concatenate([output, output**2, ranks, ranks**2, ranks * output], axis=1)

    def measured(self, means: Floats, parameters: int) -> dict[str, Floats]:
        """Return the correlation of ranks."""
        own, square = means[..., :1], means[..., 1:2]
        mean, squares, product = (
            means[..., 2 + part * parameters : 2 + (part + 1) * parameters] for part in range(3)
        )
        variances = (square - own**2) * (squares - mean**2)
        variances = np.where(variances > 0.0, variances, np.nan)
        return {"rank_correlation": (product - own * mean) / np.sqrt(variances)}


def _ranks(columns: Floats) -> Floats:
    """Return the rank of each value in its column from -1/2 to 1/2, equal values sharing theirs."""
    found = np.empty(columns.shape)
    for index, column in enumerate(columns.T):
        _, inverse, counts = np.unique(column, return_inverse=True, return_counts=True)
        middle = np.cumsum(counts) - 0.5 * (counts + 1)
        found[:, index] = middle[inverse] / max(len(column) - 1, 1) - 0.5
    return found
