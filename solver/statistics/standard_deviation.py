"""The standard deviation: root mean square about the mean, of the samples themselves (over n).

Sums are of the differences from the first sample, which lies within the channel's range: a large
mean costs no digits (Chan, Golub and LeVeque 1983, "shifted data").
"""

import numpy as np

from jointplay.solver.statistics.channel_statistic import Floats, Grid, add_in_order


class StandardDeviation:
    """Standard deviation of the samples."""

    long_name = "standard deviation"

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the first sample, and the sums of differences from it and of their squares."""
        return np.zeros((3, channels))

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the differences and their squares."""
        if before == 0:
            tally[0] = values[0]
        differences = values - tally[0]
        add_in_order(tally[1], differences)
        add_in_order(tally[2], differences * differences)

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the standard deviation."""
        mean = tally[1] / count
        variance = np.maximum(tally[2] / count - mean * mean, 0.0)
        return np.asarray(np.sqrt(variance), np.float64)
