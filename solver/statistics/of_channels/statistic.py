"""What every statistic of channels provides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Grid:
    """The samples that a statistic will be given: equally spaced, of equal weight."""

    samples: int
    per_period: int


class ChannelStatistic(Protocol):
    """A statistic of channels, each for itself, in the unit of its channel.

    Scaling a channel by a positive factor scales the statistic.
    """

    @property
    def long_name(self) -> str:
        """What it is, in words that "of" may follow."""
        ...

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the tally before the first sample: (rows, channels), bounded in rows."""
        ...

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Take (samples, channels) values, at least one, into the tally; `before` came before."""
        ...

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the statistic of the `count` samples that it was given: (channels,)."""
        ...
