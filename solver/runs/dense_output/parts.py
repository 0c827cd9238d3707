"""Parts of steps: a window cut where a step begins and where a bin does."""

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats

Indices = NDArray[np.int64]


def cut(begins: Floats, lengths: Floats, edges: Floats) -> tuple[Indices, Floats]:
    """Return the step and the bin (k, 2) of each part, and where in its step it is (k, 2).

    Parameters
    ----------
    begins, lengths : (n,)
        Of consecutive steps, s.
    edges : (bins + 1,)
        Ascending times between bins, s; what is outside the steps has no part.
    """
    end = begins[-1] + lengths[-1]
    low, high = max(edges[0], begins[0]), min(edges[-1], end)
    if not low <= high:
        return np.empty((0, 2), np.int64), np.empty((0, 2))
    inside = begins[(begins > low) & (begins < high)]
    cuts = np.concatenate([[low], inside, edges[(edges > low) & (edges < high)], [high]])
    cuts.sort(kind="stable")  # of two ascending pieces: a merge
    cuts = cuts[np.append(True, cuts[1:] > cuts[:-1])]
    if len(cuts) == 1:  # an instant
        cuts = np.repeat(cuts, 2)
    first, last = cuts[:-1], cuts[1:]
    step = np.clip(np.searchsorted(begins, first, side="right") - 1, 0, len(begins) - 1)
    number = np.clip(np.searchsorted(edges, first, side="right") - 1, 0, len(edges) - 2)
    length = np.where(lengths[step] > 0.0, lengths[step], 1.0)
    shares = np.column_stack([first - begins[step], last - begins[step]]) / length[:, None]
    following = np.append(begins[1:], end)
    shares[last >= following[step], 1] = 1.0
    return np.column_stack([step, number]).astype(np.int64), np.clip(shares, 0.0, 1.0)
