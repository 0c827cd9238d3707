"""The standard deviation: root mean square about the mean, of the samples themselves (over n).

Sums are of the differences from the first sample, which lies within the channel's range: a large
mean costs no digits (Chan, Golub and LeVeque 1983, "shifted data").
"""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import ChannelStatistic, Grid


class StandardDeviation(ChannelStatistic):
    """Standard deviation of the samples."""

    long_name = "standard deviation"
    rows = 3
    """The first sample, and the sums of differences from it and of their squares."""

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the differences and their squares."""
        if before == 0:
            tally[0] = values[0]
        differences = values - tally[0]
        self.add_in_order(tally[1], differences)
        self.add_in_order(tally[2], differences * differences)

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the standard deviation."""
        mean = tally[1] / count
        variance = np.maximum(tally[2] / count - mean * mean, 0.0)
        return np.asarray(np.sqrt(variance), np.float64)
