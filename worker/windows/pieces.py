"""Long windows in pieces: each of so many steps, their extremes put together again."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import HIGHEST, LOWEST


def between(edges: Floats, low: float, high: float) -> Floats:
    """Return the edges of bins and pieces of bins from one time to another, s."""
    inside = edges[(edges > low) & (edges < high)]
    return np.concatenate([[low], inside, [high]])


def folded(edges: Floats, begins: Floats, records: Floats) -> Floats:
    """Return the extremes (bins, names, 4) of bins from those of their pieces.

    Parameters
    ----------
    edges : (bins + 1,)
        Of the bins, s.
    begins : (k,)
        Where each piece of a bin begins, ascending, s.
    records : (k, names, 4)
        Lowest, its time, highest, its time.
    """
    if len(begins) == len(edges) - 1:
        return records
    bins = np.clip(np.searchsorted(edges, begins, side="right") - 1, 0, len(edges) - 2)
    found = np.full((len(edges) - 1, *records.shape[1:]), np.nan)
    for one, record in zip(bins, records, strict=True):
        found[one] = merged(found[one], record)
    return found


def merged(first: Floats, second: Floats) -> Floats:
    """Return the extremes (..., 4) of two pieces as of one; NaN of a piece that has none."""
    best = first.copy()
    lower = ~(second[..., LOWEST] >= best[..., LOWEST]) & ~np.isnan(second[..., LOWEST])
    higher = ~(second[..., HIGHEST] <= best[..., HIGHEST]) & ~np.isnan(second[..., HIGHEST])
    best[lower, :HIGHEST] = second[lower, :HIGHEST]
    best[higher, HIGHEST:] = second[higher, HIGHEST:]
    return best
