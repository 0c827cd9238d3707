"""The error of a mean of correlated numbers: means of batches long enough to be independent.

Sources: Flyvbjerg and Petersen 1989, J. Chem. Phys. 91:461 (batches); Wolff 2004, Comput. Phys.
Commun. 156:143 and Lee et al. 2011, Phys. Rev. E 83:066706 (their length).
"""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.estimate import SIGNIFICANT, UNKNOWN, Estimate
from jointplay.solver.nonlinear.student import student

FEWEST_BATCHES = 8
MOST_UNSEEN = 0.95
"""Share of the variance beyond the longest batches for which the correction is made at most."""


def standard_error(series: Floats) -> Floats:
    """Return the standard error of the mean of each column, (d,), of a (n, d) series in time.

    Batches double in length until B³ > 2 n r⁴, where r is the ratio (at least 1) of the error that
    batches of length B suggest to the one that takes all numbers as independent: shorter batches
    are still correlated, longer ones too few. There must be at least 8 of them; what correlation
    reaches from one batch into the next is then made up for by the factor 1/√(1 - r²/B), which is
    1 for long batches and grows, to 4.5 at most, where the correlation is as long as the record.

    Deviations are taken from the mean of each half of the record, so that a drift, which
    `mean_estimate` reports, does not pass for correlation. Few batches give an uncertain error; it
    is widened by Student's t so that three errors mean what three standard deviations mean.
    Fewer than three numbers: infinite.
    """
    seen, correction = _error_and_correction(series)
    return np.asarray(seen * correction, np.float64)


def mean_estimate(series: Floats, end_effect: float = 0.0) -> Estimate:
    """Return the mean of a (n,) series in time; the error as in `standard_error`.

    end_effect : what the mean owes to where the record begins and ends, where that is known to be
        more than batches show; the error is at least this.

    Halves that differ by more than three errors of their difference are a drift: the error is then
    at least this difference.
    """
    n = len(series)
    if n == 0:
        return UNKNOWN
    value = float(series.mean())
    if n < 3:
        return Estimate(value, math.inf)
    seen, correction = (float(a[0]) for a in _error_and_correction(series[:, None]))
    difference = abs(float(series[: n // 2].mean() - series[n // 2 :].mean()))
    # each half has twice the variance of the whole, their difference four times; the end effect of
    # a half is twice that of the whole, that of their difference up to four times
    drifting = difference > SIGNIFICANT * max(2.0 * seen, 4.0 * end_effect)
    error = max(seen * correction, end_effect, difference if drifting else 0.0)
    return Estimate(value, error, drifting)


def _error_and_correction(series: Floats) -> tuple[Floats, Floats]:
    """Return the error that the best batches show, (d,), and the factor for what they do not."""
    n, columns = series.shape
    if n < 3:
        return np.full(columns, math.inf), np.ones(columns)
    scale = np.abs(series - series[0]).max(axis=0)
    centred = (series - series[0]) / np.where(scale > 0.0, scale, 1.0)
    independent = _batch_error(centred, 1)
    error, unseen = independent, np.ones(columns)
    searching = np.ones(columns, np.bool_)
    length = 1
    while length == 1 or n // length >= FEWEST_BATCHES:
        suggested = _batch_error(centred, length)
        ratio = np.maximum(suggested / np.where(independent > 0.0, independent, 1.0), 1.0)
        error = np.where(searching, suggested * _widening(n // length), error)
        unseen = np.where(searching, ratio * ratio / length, unseen)
        searching &= length**3 <= 2.0 * n * (ratio * ratio) * (ratio * ratio)
        length *= 2
    return error * scale, 1.0 / np.sqrt(1.0 - np.minimum(unseen, MOST_UNSEEN))


def _batch_error(centred: Floats, length: int) -> Floats:
    """Return the error that independent batches of a length suggest; the oldest remainder waits."""
    n, columns = centred.shape
    batches = n // length
    recent = centred[n - batches * length :]
    means = recent.reshape(batches, length, columns).mean(axis=1)
    half = batches // 2
    squares = ((means[:half] - means[:half].mean(axis=0)) ** 2).sum(axis=0)
    squares += ((means[half:] - means[half:].mean(axis=0)) ** 2).sum(axis=0)
    return np.asarray(np.sqrt(squares / (max(batches - 2, 1) * batches)), np.float64)


def _widening(batches: int) -> float:
    """Return Student's t, two means taken out, over that of a known error, at three errors."""
    return student(max(batches - 2, 1)) / SIGNIFICANT
