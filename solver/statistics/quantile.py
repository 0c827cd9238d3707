"""Quantiles: of all samples while there are few, else of every nth, evenly over the time."""

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import ChannelStatistic, Grid

MOST_KEPT = 2048
"""Samples kept of each channel: the level of a quantile is then known to 1/2048."""


@dataclass(frozen=True)
class Quantile(ChannelStatistic):
    """The value below which a share of the samples lies, interpolated linearly between them."""

    level: float
    """0 to 1."""

    @property
    def long_name(self) -> str:
        """The median, or which quantile."""
        return "median" if self.level == 0.5 else f"{self.level:g} quantile"

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return room for the samples that will be kept."""
        return np.zeros((-(-grid.samples // stride(grid)), channels))

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Keep every nth."""
        every = stride(grid)
        kept = values[-before % every :: every]
        first = -(-before // every)
        tally[first : first + len(kept)] = kept

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the quantile of what was kept."""
        return np.asarray(np.quantile(tally, self.level, axis=0), np.float64)


def stride(grid: Grid) -> int:
    """Return every how many samples one is kept.

    It shares no factor with the samples of a period: of a periodic motion, all phases are kept.
    """
    every = -(-grid.samples // MOST_KEPT)
    while math.gcd(every, grid.per_period) > 1:
        every += 1
    return every
