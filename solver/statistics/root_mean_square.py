"""The root of the mean square: about zero, not about the mean."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import ChannelStatistic, Grid


class RootMeanSquare(ChannelStatistic):
    """Root mean square of the samples."""

    long_name = "root mean square"

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the squares."""
        self.add_in_order(tally[0], values * values)

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the root of the mean."""
        return np.asarray(np.sqrt(tally[0] / count), np.float64)
