"""Power spectral densities of channels in a window of a run."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.figures import between_samples, sampling, scene_facts
from jointplay.figures.kind import Selection
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_FEWEST_SAMPLES: Final = 32
_MOST_SAMPLES: Final = 2**20
"""Most samples: of a longer window its end is taken, where transients are over."""
_APART: Final = 1e-5
"""Seconds between instants of a trajectory that is known between samples."""
_FEWEST_INSTANTS, _MOST_INSTANTS = 2**10, 2**17
"""Their number at least, in a window of 10 ms or less, and at most, in one of seconds."""
_RESOLVED: Final = 2e-5
"""Seconds between instants that resolve an impact."""
_PERIODS: Final = 8
"""Periods of the drivers in one segment: their lines are four steps of resolution apart."""
_MOST_SEGMENTS: Final = 15
_COLUMNS: Final = 1000
"""Columns of a logarithmic axis: each shows its largest and smallest power."""
NOTHING: Final = "fewer than 32 samples, or no change"
_STRETCHES, _INTERVALS, _FARTHER = 4, 64, 1.3
"""Parts of a window that are looked at, intervals between instants in each, and by how much a
channel's range within these exceeds its change, in all, where it turns more often than instants can
tell: by up to 1.15 where it does not, by 1.57 or more from 1.3 times the highest frequency on."""
_ROUGH: Final = ("N", "N m", "m/s^2", "rad/s^2")
"""Units of channels that impacts change within microseconds."""


@dataclass(frozen=True)
class PowerDensity:
    """Power spectral density of one channel; empty where there is nothing to be seen."""

    frequency: Floats  # (m,) above zero, Hz
    power: Floats  # (m,) square of the channel's unit / Hz
    step: float  # s between the instants
    faster: bool = False
    """Whether the channel is seen to turn more often than instants can tell."""

    @property
    def band_limit(self) -> float:
        """Return the highest frequency [Hz] that instants so far apart can tell."""
        return 0.5 / self.step if self.step > 0.0 else 0.0

    def thinned(self) -> tuple[Floats, Floats]:
        """Return the largest and the smallest power of each column of a logarithmic axis.

        Each is at its own frequency: a column is up to a hundredth of it wide.
        """
        frequency, power = self.frequency, self.power
        column = np.floor(_COLUMNS * np.log(frequency / frequency[0]) / np.log(len(frequency)))
        starts = np.flatnonzero(np.diff(column, prepend=-1.0))
        if 2 * len(starts) >= len(frequency):
            return frequency, power
        by_power = np.lexsort((power, column))  # in each column
        ends = np.append(starts[1:], len(power)) - 1
        kept = np.union1d(by_power[starts], by_power[ends])
        return frequency[kept], power[kept]


def power_density(source: Source, name: str, selection: Selection) -> PowerDensity:
    """Return the density of a channel in a window; `NotDrawable` if no sample is in it."""
    values, begin, step = _samples(source, name, selection)
    faster = step > _RESOLVED and _turns_between(source, name, values, begin, step)
    return PowerDensity(*_welch(values, step, driving_frequency(source)), step, faster)


def driving_frequency(source: Source) -> float:
    """Return how often [Hz] all drivers repeat; 0 if they do not."""
    period = source.attributes.get("period") or 0.0
    return 1.0 / period if period > 0.0 else 0.0


def aliased(source: Source, spectra: Mapping[str, PowerDensity]) -> str:
    """Say of which channels what is faster than instants are apart appears at other frequencies.

    That is so where a channel turns between two of them again and again, and of forces and
    accelerations, which jump in less than a step.
    """
    notes = []
    if fast := [name for name, one in spectra.items() if one.faster]:
        notes.append(
            f"Of {', '.join(fast)}, motion is faster than these instants are apart: what lies above"
            " the highest frequency appears below it. Choose a shorter window or output_step."
        )
    step = max(one.step for one in spectra.values())
    exact = between_samples.knows(source) and step <= _RESOLVED
    units = {scene_facts.channel(source, name).unit for name in spectra if name not in fast}
    if units & set(_ROUGH) and not exact:
        notes.append(
            "Forces and accelerations change faster than their samples: what lies above the highest"
            " frequency appears below it. A smaller output_step shows how much that is."
        )
    return " ".join(notes)


def _turns_between(source: Source, name: str, values: Floats, begin: float, step: float) -> bool:
    """Return whether a channel goes much farther between instants than they are apart.

    values : (n,) at instants from `begin` on, s.
    """
    count = min(_INTERVALS, len(values) - 1)
    if source.trajectory is None or count < 1:
        return False
    within = change = 0.0
    for first in np.linspace(0, len(values) - 1 - count, _STRETCHES).astype(np.int64).tolist():
        chosen = np.arange(first, first + count + 1)
        found = source.trajectory.extremes([name], begin + step * chosen)
        if found.values is None:
            return False
        within += float((found.values[:, 0, 2] - found.values[:, 0, 0]).sum())
        change += float(np.abs(np.diff(values[chosen])).sum())
    return within > _FARTHER * change


def _samples(source: Source, name: str, selection: Selection) -> tuple[Floats, float, float]:
    """Give (n,) values that are equally far apart, when they begin and how far that is [s]."""
    first, last = sampling.window(source, selection)
    start, stop = between_samples.ends(source, selection)
    if between_samples.knows(source) and stop > start:
        count = int(np.clip((stop - start) / _APART, _FEWEST_INSTANTS, _MOST_INSTANTS)) + 1
        exact = between_samples.at(source, [name], np.linspace(start, stop, count))
        if exact is not None:
            return exact[1][name], start, (stop - start) / (count - 1)
    time, columns = sampling.joined(source, [name], max(first, last - _MOST_SAMPLES), last)
    values = columns[name]
    missing = np.flatnonzero(~np.isfinite(values))
    known = int(missing[0]) if len(missing) else len(values)
    if known > 2 and time[known - 1] - time[known - 2] < 0.99 * (time[1] - time[0]):
        known -= 1  # the end of the run, between two output steps
    step = float(time[known - 1] - time[0]) / (known - 1) if known > 1 else 0.0
    return values[:known], float(time[0]), step


def _welch(values: Floats, step: float, drive: float) -> tuple[Floats, Floats]:
    """Give (m,) frequencies above zero [Hz] and power spectral density [unit^2/Hz].

    Welch's average over half-overlapping Hann windows, as many as leave `_PERIODS` of the drivers
    in each; its sum over frequency is the variance. m = 0 where there is nothing to be seen.
    Importing SciPy's takes longer than drawing the figure.
    """
    if len(values) < _FEWEST_SAMPLES or np.ptp(values) == 0.0:
        return np.empty(0), np.empty(0)
    apart = drive * step * len(values) / _PERIODS  # without drivers 0: one window, sharp lines
    segments = int(np.clip(2.0 * apart - 1.0, 1, min(_MOST_SEGMENTS, len(values) // 16)))
    length = 2 * len(values) // (segments + 1)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(length) / length)
    pieces = np.lib.stride_tricks.sliding_window_view(values, length)[:: length - length // 2]
    parts = np.fft.rfft(window * (pieces - pieces.mean(axis=1, keepdims=True)))
    power = (np.abs(parts) ** 2).mean(axis=0) * (2.0 * step / float((window**2).sum()))
    if length % 2 == 0:
        power[-1] *= 0.5  # half the sampling frequency has no twin below zero
    frequency = np.fft.rfftfreq(length, step)
    return np.asarray(frequency[1:], np.float64), np.asarray(power[1:], np.float64)
