"""Smallest and largest samples of each channel, which no extreme of the run falls short of."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak

PROMISED: Final = 1e-6
"""Share of a channel's range by which its extremes may be off."""
ROUNDING: Final = 1e-9
"""Share of the largest range of all channels that may be nothing but rounding."""


class SampledExtremes:
    """Extremes among samples, whose bits do not depend on slices.

    Extremes are sought inside steps where a channel may have a record by what it is at their ends.
    Where a mechanism passes a singular position, reactions have a pole, of which the ends of a step
    say nothing: there a sample may be beyond all that was found.

    Parameters
    ----------
    width
        Number of channels.
    since : s
        Samples before do not count.
    """

    def __init__(self, width: int, since: float) -> None:
        self._since = since
        self._found = np.full((2, width, 2), np.nan)

    def add(self, time: Floats, samples: Floats) -> None:
        """Look at further samples (n, width) at `time` (n,), s."""
        first = int(np.searchsorted(time, self._since))
        if first == len(time):
            return
        time, samples = time[first:], samples[first:]
        for found, sense in zip(self._found, (-1.0, 1.0), strict=True):
            most = sense * (samples.max(axis=0) if sense > 0.0 else samples.min(axis=0))
            beyond = np.flatnonzero(~(most <= sense * found[:, 0]))
            where = (sense * samples[:, beyond]).argmax(axis=0)
            found[beyond, 0], found[beyond, 1] = samples[where, beyond], time[where]

    def held_against(self, peaks: Mapping[str, Peak]) -> dict[str, Peak]:
        """Return extremes by channel, in the order of the samples', none short of a sample.

        One that a sample exceeds by no more than `PROMISED` of the range stays as it is.
        """
        held = {}
        widest = max((peak.maximum - peak.minimum for peak in peaks.values()), default=0.0)
        for index, (name, peak) in enumerate(peaks.items()):
            (low, low_time), (high, high_time) = self._found[:, index].tolist()
            allowed = PROMISED * (max(peak.maximum, high) - min(peak.minimum, low))
            allowed += ROUNDING * widest
            lowest = (peak.minimum, peak.minimum_time)
            highest = (peak.maximum, peak.maximum_time)
            held[name] = Peak(
                *((low, low_time) if low < peak.minimum - allowed else lowest),
                *((high, high_time) if high > peak.maximum + allowed else highest),
            )
        return held

    def state(self, name: str) -> dict[str, NDArray[Any]]:
        """Return what the next call depends on, as arrays of a checkpoint."""
        return {f"{name}/found": self._found.copy()}

    def restore(self, saved: Mapping[str, NDArray[Any]], name: str) -> None:
        """Continue from `state`, bit for bit."""
        self._found = saved[f"{name}/found"].copy()
