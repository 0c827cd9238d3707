"""The power spectrum of a series: lines for regular motion, a continuum for chaos."""

from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.fourier import transformed
from jointplay.solver.quantities.scalars import exponential, logarithm, sine_cosine


@dataclass(frozen=True)
class Spectrum:
    """One-sided power spectral density of a series less its mean.

    frequency : (m,) from 0 to half the sampling frequency, per unit of the interval: cycles per
        period for one sample a period, Hz for an interval in s.
    density : (m,) or (m, d), unit of the series squared per unit of frequency; its sum times
        `resolution` is the variance.
    resolution : spacing of the frequencies.
    """

    frequency: Floats
    density: Floats
    resolution: float


def power_spectrum(series: Floats, interval: float = 1.0, segments: int = 1) -> Spectrum:
    """Return the spectrum of a (n,) or (n, d) series with samples an interval apart.

    segments : 1 for the periodogram, which resolves lines best; more for Welch's average over that
        many half-overlapping Hann windows, which steadies a continuum.

    Raises
    ------
    ValueError
        If the interval is not positive, or a segment would have fewer than eight samples.
    """
    values = np.asarray(series, np.float64)
    length = 2 * len(values) // (segments + 1)
    if not interval > 0.0 or segments < 1 or length < 8:
        raise ValueError("a spectrum needs a positive interval and eight samples a segment")
    window = np.ones(length)
    if segments > 1:
        _, cosine = sine_cosine((2.0 * np.pi / length) * np.arange(length))
        window = 0.5 - 0.5 * cosine
    columns = values.reshape(len(values), -1)
    apart = min(length - length // 2, (len(values) - length) // max(segments - 1, 1))
    begins = [i * apart for i in range(segments)]
    total = reduce(add, (_periodogram(columns[i : i + length], window) for i in begins))
    density = total * (interval / ((window * window).sum() * len(begins)))
    frequency = np.arange(len(density)) / (length * interval)
    shape = (len(frequency), *values.shape[1:])
    return Spectrum(frequency, density.reshape(shape), 1.0 / (length * interval))


def _periodogram(columns: Floats, window: Floats) -> Floats:
    """Return the squares of the one-sided transform of columns (n, d) less their means."""
    centred = columns - columns.mean(axis=0)
    real, imaginary = transformed((window[:, None] * centred, np.zeros_like(centred)))
    n = len(columns)
    squares = (real * real + imaginary * imaginary)[: n // 2 + 1]
    squares[1 : (n + 1) // 2] *= 2.0
    return np.asarray(squares, np.float64)


def strongest_line(spectrum: Spectrum) -> tuple[float, float]:
    """Return the frequency of the most power, summed over columns of equal variance, and its share.

    The share, 0 to 1, is of the power within one step of resolution to either side: near 1 for a
    single line, near 0 for a continuum. A constant series has the frequency and share 0.
    """
    power = _relative(spectrum)
    total = float(power.sum())
    if total == 0.0:
        return 0.0, 0.0
    peak = int(power.argmax())
    around = float(power[max(peak - 1, 0) : peak + 2].sum())
    return float(spectrum.frequency[peak]), around / total


def flatness(spectrum: Spectrum) -> float:
    """Return the geometric over the arithmetic mean of the power: 0 for lines, 1 for white noise.

    A periodogram of white noise reaches 0.56 only (exp of minus Euler's constant), because its
    ordinates scatter; averaging segments brings it to 1. Constant series: 0.
    """
    power = _relative(spectrum)[1:]  # the mean has been taken out
    if float(power.sum()) == 0.0:
        return 0.0
    floor = np.finfo(np.float64).eps ** 2 * float(power.max())
    return float(exponential(float(logarithm(np.maximum(power, floor)).mean())) / power.mean())


def _relative(spectrum: Spectrum) -> Floats:
    """Return the power of all columns together, each divided by its variance, (m,)."""
    density = spectrum.density.reshape(len(spectrum.frequency), -1)
    total = density.sum(axis=0)
    return np.asarray((density / np.where(total > 0.0, total, 1.0)).sum(axis=1), np.float64)
