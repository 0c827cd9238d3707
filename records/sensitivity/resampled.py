"""Bootstrap over rows: how far means of a sample are apart from those of others."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats

MOST_RESAMPLES: Final = 1000
_FEWEST_RESAMPLES: Final = 200
_MOST_DRAWS: Final = 4_000_000
"""Rows that are drawn for one question: some tenths of a second."""
_AT_ONCE: Final = 500_000


def resamples_of(rows: int) -> int:
    """Return how many resamples are drawn."""
    return int(np.clip(_MOST_DRAWS // max(rows, 1), _FEWEST_RESAMPLES, MOST_RESAMPLES))


def resampled_means(moments: Floats) -> Floats:
    """Return (resamples, moments) means over rows of each resample, from (rows, moments).

    The same rows are drawn whenever it is asked.
    """
    rows = len(moments)
    return np.concatenate([counts @ moments / rows for counts in _counts(rows)])


def between(resamples: Floats, confidence: float) -> tuple[Floats, Floats]:
    """Return both ends of what the middle share of resamples covers; NaN where none is known."""
    ends = 50.0 * (1.0 - confidence), 50.0 * (1.0 + confidence)
    found = np.full((2, *resamples.shape[1:]), np.nan)
    known = np.isfinite(resamples).any(axis=0)
    found[:, known] = np.nanpercentile(resamples[:, known], ends, axis=0)
    return found[0], found[1]


def _counts(rows: int) -> Iterator[Floats]:
    generator = np.random.default_rng(0)
    left = resamples_of(rows)
    while left:
        some = min(left, max(_AT_ONCE // max(rows, 1), 1))
        drawn = generator.integers(0, rows, (some, rows)) + rows * np.arange(some)[:, None]
        yield np.bincount(drawn.ravel(), minlength=some * rows).reshape(some, rows).astype(float)
        left -= some
