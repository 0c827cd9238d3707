"""The mean: the first sample, and the mean of what the others differ from it."""

import numpy as np

from jointplay.solver.statistics.channel_statistic import Floats, Grid, add_in_order


class Mean:
    """Mean of the samples."""

    long_name = "mean"

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the first sample, and the sum of differences from it."""
        return np.zeros((2, channels))

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the differences."""
        if before == 0:
            tally[0] = values[0]
        add_in_order(tally[1], values - tally[0])

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the mean."""
        mean: Floats = tally[0] + tally[1] / count
        return mean
