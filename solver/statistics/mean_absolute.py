"""The mean absolute value: the rectified mean."""

import numpy as np

from jointplay.solver.statistics.channel_statistic import Floats, Grid, add_in_order


class MeanAbsolute:
    """Mean absolute value of the samples."""

    long_name = "mean absolute value"

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the sum of absolute values."""
        return np.zeros((1, channels))

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the absolute values."""
        add_in_order(tally[0], np.abs(values))

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the mean."""
        mean: Floats = tally[0] / count
        return mean
