"""Whether the statistics of consecutive windows of a motion have stopped changing."""

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.nonlinear.batch_means import standard_error
from jointplay.solver.nonlinear.estimate import SIGNIFICANT

BLUR = 0.5
"""Sampling error over spread above which a window is too short to have statistics: a drift, one
flank of a slow beat, or the amplitude of a motion that dies out looks like that."""
TINY = float(np.finfo(np.float64).tiny)


def change_between(windows: Sequence[Floats], tolerance: float) -> str:
    """Return what changes between windows (n, d) of a motion; empty: nothing noticeable.

    The windows follow one another, and any two must agree, in every column: their means and their
    standard deviations within three sampling errors, which count correlation, or within the
    tolerance. Where a sampling error exceeds half the spread, only the tolerance counts.
    """
    for name, statistic in (("mean", _means), ("spread", _spreads)):
        for a, b in combinations([statistic(window) for window in windows], 2):
            sampling = SIGNIFICANT * np.hypot(a.error, b.error)
            allowed = np.maximum(np.where(a.blurred | b.blurred, 0.0, sampling), tolerance)
            excess = np.abs(b.value - a.value) / np.maximum(allowed, TINY)
            column = int(excess.argmax())
            if excess[column] > 1.0:
                length = len(windows[-1])
                return f"the {name} of column {column} still changes over {length} sections"
    return ""


class _Statistic(NamedTuple):
    """A number for each column (d,), its sampling error, and whether that means anything."""

    value: Floats
    error: Floats
    blurred: Flags


def _means(window: Floats) -> _Statistic:
    error = standard_error(window)
    return _Statistic(np.asarray(window.mean(axis=0)), error, error > BLUR * window.std(axis=0))


def _spreads(window: Floats) -> _Statistic:
    """Return standard deviations, by way of the variances."""
    variance = _means((window - window.mean(axis=0)) ** 2)
    spread = np.sqrt(variance.value)
    return _Statistic(
        spread, variance.error / (2.0 * np.where(spread > 0.0, spread, 1.0)), variance.blurred
    )
