"""The mean: the first sample, and the mean of what the others differ from it."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import ChannelStatistic, Grid


class Mean(ChannelStatistic):
    """Mean of the samples."""

    long_name = "mean"
    rows = 2
    """The first sample, and the sum of differences from it."""

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the differences."""
        if before == 0:
            tally[0] = values[0]
        self.add_in_order(tally[1], values - tally[0])

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the mean."""
        return np.asarray(tally[0] + tally[1] / count, np.float64)
