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
        """Return room for the samples that will be kept; NaN where none is."""
        most = MOST_KEPT if grid.open_ended else -(-grid.samples // stride(grid, grid.samples))
        return np.full((min(most, grid.samples), channels), np.nan)

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Keep every nth; of those before, too, where n has grown."""
        every, last = stride(grid, before + len(values)), stride(grid, before)
        if every > last:
            fewer = tally[:: every // last].copy()
            tally[: len(fewer)], tally[len(fewer) :] = fewer, np.nan
        kept = values[-before % every :: every]
        first = -(-before // every)
        tally[first : first + len(kept)] = kept

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the quantile of what was kept."""
        kept = tally[~np.isnan(tally).all(axis=1)]
        return np.asarray(np.quantile(kept, self.level, axis=0), np.float64)


def stride(grid: Grid, samples: int) -> int:
    """Return every how many samples one is kept, of so many that there have been.

    It shares no factor with the samples of a period: of a periodic motion, all phases are kept. On
    an open-ended grid it grows by a factor wherever there is no more room.
    """
    if grid.open_ended:
        factor, every = _coprime(2, grid.per_period), 1
        while samples > every * MOST_KEPT:
            every *= factor
        return every
    return _coprime(-(-grid.samples // MOST_KEPT), grid.per_period)


def _coprime(least: int, number: int) -> int:
    """Return the smallest number from `least` on that shares no factor with another."""
    while math.gcd(least, number) > 1:
        least += 1
    return least
