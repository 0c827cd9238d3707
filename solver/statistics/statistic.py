"""Statistics of channels, and of contacts: what every member provides, and shares."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats

Contacts = NDArray[np.void]
"""Contacts of dtype `records.impact.IMPACT`, their release NaN where they last."""


@dataclass(frozen=True)
class Grid:
    """The samples that a statistic will be given: equally spaced, of equal weight."""

    samples: int
    per_period: int
    open_ended: bool = False
    """Whether the run may end before there are so many."""


class ChannelStatistic(ABC):
    """A statistic of channels, each for itself, in the unit of its channel.

    Scaling a channel by a positive factor scales the statistic.
    """

    rows = 1
    """Rows of the tally."""

    @property
    @abstractmethod
    def long_name(self) -> str:
        """Its name in words that "of" may follow."""

    def begin(self, grid: Grid, channels: int) -> Floats:
        """Return the tally before the first sample: (rows, channels), bounded in rows."""
        return np.zeros((self.rows, channels))

    @abstractmethod
    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Take (samples, channels) values, at least one, into the tally; `before` came before."""

    @abstractmethod
    def value(self, tally: Floats, count: int) -> Floats:
        """Return the statistic of the `count` samples that it was given: (channels,)."""

    @staticmethod
    def add_in_order(total: Floats, terms: Floats) -> None:
        """Add (rows, channels) terms to a (channels,) total in place, one row after the other.

        The result does not depend on how the rows were cut: numpy's sums take another order for
        another number of rows. The rounding of n terms in order is at most n * 1e-16 of the sum of
        their magnitudes.
        """
        total[:] = np.add.accumulate(np.concatenate([total[None], terms]), axis=0)[-1]


class ContactStatistic(ABC):
    """A statistic of the contacts of each pair over a stretch of time.

    Contacts that began before the stretch, or last beyond it, are part of it as far as they reach.
    The tally begins with zeros, (pairs,).
    """

    unit: str
    long_name: str
    """Its name in words."""

    @abstractmethod
    def add(self, tally: Floats, contacts: Contacts, start: float, end: float) -> None:
        """Take contacts into the (pairs,) tally; the stretch is from start to end, s."""

    def value(self, tally: Floats, start: float, end: float) -> Floats:
        """Return the statistic, (pairs,)."""
        return tally
