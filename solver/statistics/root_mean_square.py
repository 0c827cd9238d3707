"""The root of the mean square: about zero, not about the mean."""

import numpy as np

from jointplay.solver.statistics.channel_statistic import Floats, Grid, add_in_order


class RootMeanSquare:
    """Root mean square of the samples."""

    long_name = "root mean square"

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the sum of squares."""
        return np.zeros((1, channels))

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Add the squares."""
        add_in_order(tally[0], values * values)

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the root of the mean."""
        return np.asarray(np.sqrt(tally[0] / count), np.float64)
