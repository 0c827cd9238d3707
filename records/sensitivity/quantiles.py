"""Quantiles of a sample, with intervals by its order statistics."""

import numpy as np

from jointplay.records.arrays import Floats

_ROUNDING = 1e-12


def quantiles(sample: Floats, shares: Floats, confidence: float) -> tuple[Floats, Floats, Floats]:
    """Return (shares,) the least values up to which such shares lie, and the ends of intervals.

    How many of n independent values lie below a quantile is binomial, whatever their distribution
    (David and Nagaraja 2003, Order Statistics, 3rd ed., section 7.1). NaN: more values are needed.

    Parameters
    ----------
    sample
        (n,) in any order.
    shares
        (shares,) between 0 and 1.
    """
    ordered = np.sort(sample)
    count = len(ordered)
    indices = np.ceil(shares * count * (1.0 - _ROUNDING)).astype(np.int64)
    ends = np.array([_ends(count, share, confidence) for share in shares.tolist()])
    low, high = np.concatenate([[np.nan], ordered, [np.nan]])[ends].T
    return ordered[indices - 1], low, high


def _ends(count: int, share: float, confidence: float) -> tuple[int, int]:
    """Return numbers of the values, from 1, between which a quantile lies; 0, count + 1: none."""
    more = np.arange(1.0, count + 1.0)
    ratios = np.log((count + 1.0 - more) / more) + np.log(share / (1.0 - share))
    logarithms = np.concatenate([[0.0], np.cumsum(ratios)])
    masses = np.exp(logarithms - logarithms.max())
    below = np.cumsum(masses) / masses.sum()
    tail = 0.5 - 0.5 * confidence
    low = np.searchsorted(below, tail, side="right")
    return int(low), int(np.searchsorted(below, 1.0 - tail)) + 1
