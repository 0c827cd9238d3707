"""Power spectral densities of channels in a window of a run."""

from collections.abc import Sequence
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
_ROUGH: Final = ("N", "N m", "m/s^2", "rad/s^2")
"""Units of channels that impacts change within microseconds."""


@dataclass(frozen=True)
class PowerDensity:
    """Power spectral density of one channel; empty where there is nothing to be seen."""

    frequency: Floats  # (m,) above zero, Hz
    power: Floats  # (m,) square of the channel's unit / Hz
    step: float  # s between the instants

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
    values, step = _samples(source, name, selection)
    return PowerDensity(*_welch(values, step, driving_frequency(source)), step)


def driving_frequency(source: Source) -> float:
    """Return how often [Hz] all drivers repeat; 0 if they do not."""
    period = source.attributes.get("period") or 0.0
    return 1.0 / period if period > 0.0 else 0.0


def aliased(source: Source, names: Sequence[str], step: float) -> str:
    """Say what samples make of forces and accelerations, which jump in less than a step."""
    if all(scene_facts.channel(source, name).unit not in _ROUGH for name in names):
        return ""
    if between_samples.knows(source) and step <= _RESOLVED:
        return ""
    return (
        "Forces and accelerations change faster than their samples: what lies above the highest"
        " frequency appears below it. A smaller output_step shows how much that is."
    )


def _samples(source: Source, name: str, selection: Selection) -> tuple[Floats, float]:
    """Give (n,) values that are equally far apart, and how far [s]."""
    first, last = sampling.window(source, selection)
    start, stop = between_samples.ends(source, selection)
    if between_samples.knows(source) and stop > start:
        count = int(np.clip((stop - start) / _APART, _FEWEST_INSTANTS, _MOST_INSTANTS)) + 1
        exact = between_samples.at(source, [name], np.linspace(start, stop, count))
        if exact is not None:
            return exact[1][name], (stop - start) / (count - 1)
    time, columns = sampling.joined(source, [name], max(first, last - _MOST_SAMPLES), last)
    values = columns[name]
    missing = np.flatnonzero(~np.isfinite(values))
    known = int(missing[0]) if len(missing) else len(values)
    if known > 2 and time[known - 1] - time[known - 2] < 0.99 * (time[1] - time[0]):
        known -= 1  # the end of the run, between two output steps
    step = float(time[known - 1] - time[0]) / (known - 1) if known > 1 else 0.0
    return values[:known], step


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
