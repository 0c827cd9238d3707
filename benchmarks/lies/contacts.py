"""A run's certified contacts against those of two far finer runs."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from benchmarks.lies.run import Onsets

ROUNDING = 1e-13
"""Share of a run's length."""


def contacts_hold(
    impacts: Mapping[str, Any] | None, own: Onsets, truths: tuple[Onsets, Onsets], duration: float
) -> bool | None:
    """Return whether certified contacts are those of the motion, each as late as it may be.

    Every pair must have as many until `impacts.until`, each within `impacts.onset_error` of its
    onset. None: nothing is certified, or the truths do not agree on how many there are.
    """
    if impacts is None:
        return None
    allowed, right = (impacts["onset_error"] or 0.0) + ROUNDING * duration, True
    for pair in {*own, *truths[0], *truths[1]}:
        every = [onsets.get(pair, np.zeros(0)) for onsets in (own, *truths)]
        said, true, doubted = (onsets[onsets <= impacts["until"]] for onsets in every)
        if len(true) != len(doubted):
            return None
        right &= len(said) == len(true) and bool(np.all(np.abs(said - true) <= allowed))
    return right
