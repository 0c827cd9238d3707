"""Spread over the lanes of a bundle: of extremes, and of shares of time.

Beyond its horizon a trajectory is one of many that are as good; what they have in common is what
can be said of the motion.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

BINS = 16


def histogram(values: Floats, time: Floats) -> tuple[Floats, Floats, Floats]:
    """Return bins' edges and shares of time in them with their standard deviation over lanes.

    Parameters
    ----------
    values : (lanes, instants, channels)
        Not a number where a lane was left behind: that lane does not count.
    time : (instants,)
        s; an instant stands for half the time to its neighbours.

    Returns
    -------
    (BINS + 1, channels), (BINS, channels), (BINS, channels)
    """
    whole = values[~np.isnan(values).any(axis=(1, 2))]
    lanes, _, channels = whole.shape
    if not lanes:
        nothing = np.full((BINS, channels), np.nan)
        return np.full((BINS + 1, channels), np.nan), nothing, nothing
    weights = np.gradient(time)
    weights[[0, -1]] *= 0.5
    low, high = whole.min(axis=(0, 1)), whole.max(axis=(0, 1))
    width = np.where(high > low, high - low, 1.0)
    bins = np.minimum((BINS * (whole - low) / width).astype(np.int64), BINS - 1)
    places = bins * channels + np.arange(channels)
    each = np.broadcast_to(weights[:, None], places.shape[1:]).ravel()
    counts = [np.bincount(at.ravel(), each, BINS * channels) for at in places]
    shares = np.array(counts).reshape(lanes, BINS, channels) / weights.sum()
    edges = low + (high - low) * np.linspace(0.0, 1.0, BINS + 1)[:, None]
    return edges, shares.mean(axis=0), shares.std(axis=0, ddof=1 if lanes > 1 else 0)
