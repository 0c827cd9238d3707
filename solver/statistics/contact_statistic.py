"""Statistics of the contacts of joints with clearance: what every member provides."""

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats

Contacts = NDArray[np.void]
"""Contacts that ended, of dtype `solver.runs.results.IMPACT`."""


class ContactStatistic(ABC):
    """A statistic of the contacts of each joint with clearance over a stretch of time.

    Contacts that began before the stretch, or last beyond it, are part of it as far as they reach.
    The tally begins with zeros, (joints,).
    """

    unit: str
    long_name: str
    """Its name in words."""

    @abstractmethod
    def add(self, tally: Floats, contacts: Contacts, start: float, end: float) -> None:
        """Take contacts into the (joints,) tally; the stretch is from start to end, s."""

    def value(self, tally: Floats, start: float, end: float) -> Floats:
        """Return the statistic, (joints,)."""
        return tally
