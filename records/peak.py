"""Peaks: signed extremes of channels over a whole run, found between the samples too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

PEAK: Final = {
    "minimum": {"long_name": "smallest value, in the unit of its channel"},
    "minimum_time": {"units": "s", "long_name": "time of the smallest value"},
    "maximum": {"long_name": "largest value, in the unit of its channel"},
    "maximum_time": {"units": "s", "long_name": "time of the largest value"},
}
"""Numbers of a peak, in this order, with the attributes of their arrays (CF conventions)."""
LOWEST, LOWEST_TIME, HIGHEST, HIGHEST_TIME = range(len(PEAK))
"""Where each of them is in an array of peaks."""


@dataclass(frozen=True)
class Peak:
    """Signed extremes of one channel, each with its time [s]."""

    minimum: float
    minimum_time: float
    maximum: float
    maximum_time: float

    @property
    def larger(self) -> tuple[float, float]:
        """The extreme of the larger magnitude, with its sign, and its time [s]."""
        low, high = (self.minimum, self.minimum_time), (self.maximum, self.maximum_time)
        return high if abs(self.maximum) > abs(self.minimum) else low

    def scaled(self, factor: float, offset: float) -> Peak:
        """Return the extremes of factor * channel + offset."""
        low = (factor * self.minimum + offset, self.minimum_time)
        high = (factor * self.maximum + offset, self.maximum_time)
        return Peak(*low, *high) if factor >= 0.0 else Peak(*high, *low)


class PeakColumns(NamedTuple):
    """Signed extremes of one channel at many points: (points,) each; NaN where there are none."""

    minimum: NDArray[np.float64]
    minimum_time: NDArray[np.float64]
    maximum: NDArray[np.float64]
    maximum_time: NDArray[np.float64]
