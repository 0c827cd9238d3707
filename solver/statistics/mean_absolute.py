"""The mean absolute value: the rectified mean."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import ChannelStatistic, Grid


class MeanAbsolute(ChannelStatistic):
    """Mean absolute value of the samples."""

    long_name = "mean absolute value"

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the absolute values."""
        self.add_in_order(tally[0], np.abs(values))

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the mean."""
        return np.asarray(tally[0] / count, np.float64)
