"""The 0-1 test for chaos: a sum driven by the series wanders like a random walk, or stays.

Source: Gottwald and Melbourne 2009, SIAM J. Appl. Dyn. Syst. 8:129 (arXiv 0906.1418): the modified
mean square displacement with the correlation method.
"""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.estimate import UNKNOWN, Estimate
from jointplay.solver.nonlinear.fourier import (
    Complex,
    conjugate,
    inverse,
    power_of_two,
    times,
    transformed,
)
from jointplay.solver.quantities.scalars import sine_cosine

FREQUENCIES = 100
"""Random frequencies c, whose median is taken: near a line of the spectrum K is not 0 or 1."""
AT_ONCE = 2**16
"""Samples that are transformed together: what a processor has at hand."""
REACHES = 3
"""Length of a transform, in the longest displacement at least: a longer one has more stages, a
shorter one more samples twice."""
LOWEST, HIGHEST = math.pi / 5.0, 4.0 * math.pi / 5.0
FEWEST_SAMPLES = 30
FEWEST_TELLING = 300
"""Below this regular and chaotic series of the textbook systems overlap."""
NORMAL = 1.4826
"""Standard deviation of normal numbers over their median absolute deviation."""


def zero_one_test(series: Floats, seed: int = 0, resolution: float | Floats = 0.0) -> Estimate:
    """Return K: near 1 for chaos, near 0 for periodic and quasi-periodic series.

    series : (n,) or (n, d), one sample per forcing period (a Poincaré section). Samples closer in
        time hide chaos: K tends to 0 when the series looks smooth. n = 1000 or more; below 300 the
        error is 1, which says that nothing is known.
    seed : of the 100 frequencies c, uniform in (π/5, 4π/5).
    resolution : (d,) or one number, unit of the series: a column whose whole range is no larger is
        constant. Without it the last bits of a motion of period 1 are analysed: the test has no
        scale.

    The translation (p, q) is driven by the series less its mean: the oscillatory term V_osc, which
    Gottwald and Melbourne subtract, then is zero, and shifting the series changes nothing. K_c is
    the correlation of the mean square displacement M_c(n), n up to N/10, with n, and K the median
    over c. Of several columns the constant ones are left out and the median of the others' K
    taken: chaos shows in almost every projection of a motion.

    The error is a robust standard deviation (1.4826 median absolute deviations) of K_c over c, or
    of K over the columns if that is larger. Transients and strange motions that are not chaotic
    give values in between with a large error.

    Raises
    ------
    ValueError
        If a sample is not finite.
    """
    columns = np.asarray(series, np.float64).reshape(len(series), -1).T
    if not np.isfinite(columns).all():
        raise ValueError("the 0-1 test needs finite samples; leave out sections never reached")
    n = columns.shape[1]
    if n < FEWEST_SAMPLES:
        return UNKNOWN
    extent = np.ptp(columns, axis=1)
    rounding = 64.0 * np.finfo(np.float64).eps * np.abs(columns).max(axis=1)
    moving = extent > np.maximum(rounding, resolution)
    if not moving.any():
        return Estimate(0.0, 0.0)
    centred = columns[moving] - columns[moving].mean(axis=1, keepdims=True)
    correlations = _correlations(centred / extent[moving, None], seed)
    medians = np.median(correlations, axis=1)
    spread = float(np.median(NORMAL * _median_deviation(correlations)))
    between = float(NORMAL * _median_deviation(medians[None, :])[0])
    error = max(spread, between, 1.0 if n < FEWEST_TELLING else 0.0)
    return Estimate(float(np.median(medians)), error)


def _correlations(driving: Floats, seed: int) -> Floats:
    """Return K_c (columns, FREQUENCIES) for driving series (columns, n) of mean zero."""
    columns, n = driving.shape
    generator = np.random.default_rng(seed)
    frequencies = LOWEST + (HIGHEST - LOWEST) * generator.random(FREQUENCIES)
    counted = np.arange(1.0, n + 1.0)[:, None, None]
    spectra = _spectra(driving.T)
    together = max(AT_ONCE // driving.size, 1)
    found = []
    for c in np.split(frequencies, range(together, FREQUENCIES, together)):
        sine, cosine = sine_cosine(c[:, None] * counted)
        displacement = _mean_square_displacement(driving.T, spectra, (cosine, sine))
        by_row = np.ascontiguousarray(displacement.reshape(len(displacement), -1).T)
        found.append(_correlation_with_time(by_row).reshape(len(c), columns))
    return np.concatenate(found).T


def _blocks(n: int) -> tuple[int, int, int]:
    """Return a block's starts, how many blocks have them all, and the length of a transform.

    It is long enough for the samples that a block's starts reach, so that none is met twice.
    """
    reach = n // 10
    size = power_of_two(REACHES * reach)
    return size - reach, -(-(n - reach) // (size - reach)), size


def _spectra(driving: Floats) -> Complex:
    """Return the transforms (size, blocks, 1, columns) of what each block's starts reach."""
    n, columns = driving.shape
    length, blocks, size = _blocks(n)
    behind = np.zeros(((blocks - 1) * length + size, columns))
    behind[:n] = driving[: len(behind)]
    parts = [behind[length * b : length * b + size] for b in range(blocks)]
    reached = np.concatenate(parts, axis=1)
    real, imaginary = transformed((reached, np.zeros_like(reached)))
    shape = size, blocks, 1, columns
    return real.reshape(shape), imaginary.reshape(shape)


def _mean_square_displacement(driving: Floats, spectra: Complex, turning: Complex) -> Floats:
    """Return M_c(n), (reach, frequencies, columns), for n = 1..reach: over the first starts.

    |z_{j+n} - z_j|² = |z_{j+n}|² + |z_j|² - 2 Re z̄_j z_{j+n}. From n - 1 to n the sum of the last
    over j grows by e^{icn} Σ_j z̄_j e^{icj} φ_{j+n}: correlations with the series itself, whose
    transforms are the same for all frequencies. They are taken block by block of starts.

    driving : (n, columns). turning : (n, frequencies, 1) e^{icj} for j = 1..n.
    """
    n = len(driving)
    reach = n // 10
    starts = n - reach
    length, blocks, size = _blocks(n)
    z = _accumulated(times(turning, (driving[:, None], np.zeros(1))))
    squares = np.zeros((n + 1, *z[0].shape[1:]))
    np.add.accumulate(z[0] * z[0] + z[1] * z[1], axis=0, out=squares[1:])
    back = times(z, conjugate(turning))
    cut = []
    for part in back:
        whole = np.zeros((blocks * length, *part.shape[1:]))
        whole[:starts] = part[:starts]
        block = np.zeros((size, blocks, *part.shape[1:]))
        block[:length] = whole.reshape(blocks, length, *part.shape[1:]).swapaxes(0, 1)
        cut.append(block)
    flat = transformed((cut[0].reshape(size, -1), cut[1].reshape(size, -1)))
    ahead = conjugate((flat[0].reshape(cut[0].shape), flat[1].reshape(cut[0].shape)))
    summed = [part.sum(axis=1) for part in times(ahead, spectra)]
    grown = inverse((summed[0].reshape(size, -1), summed[1].reshape(size, -1)))
    shifts = np.arange(1, reach + 1)
    shape = reach, *z[0].shape[1:]
    gains = grown[0][shifts].reshape(shape), grown[1][shifts].reshape(shape)
    turns = turning[0][:reach], turning[1][:reach]
    correlation = squares[starts] + _accumulated(times(turns, gains))[0]
    arriving = squares[starts + shifts] - squares[shifts]
    return np.asarray((arriving + squares[starts] - 2.0 * correlation) / starts, np.float64)


def _accumulated(z: Complex) -> Complex:
    """Return the sums of all rows up to each."""
    return np.add.accumulate(z[0], axis=0), np.add.accumulate(z[1], axis=0)


def _correlation_with_time(displacement: Floats) -> Floats:
    """Return the correlation coefficient of each row with the numbers 1, 2, 3 and so on."""
    reach = displacement.shape[1]
    time = np.arange(reach) - 0.5 * (reach - 1)
    centred = displacement - displacement.mean(axis=1, keepdims=True)
    variance = (time**2).sum() * (centred**2).sum(axis=1)
    covariance = (time * centred).sum(axis=1)
    return np.asarray(covariance / np.sqrt(np.where(variance > 0.0, variance, 1.0)), np.float64)


def _median_deviation(values: Floats) -> Floats:
    """Return the median absolute deviation of each row."""
    middle = np.median(values, axis=1, keepdims=True)
    return np.asarray(np.median(np.abs(values - middle), axis=1), np.float64)
