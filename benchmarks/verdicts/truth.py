"""Motions as thousands of sections of an independent program show them."""

from typing import Final

import numpy as np

from jointplay.records.arrays import Floats

LENGTHS: Final = (2400, 900)
"""Periods that a point is followed for, and its neighbours."""
LOOKED_AT: Final = 256
"""Sections at the end that recur or not."""
PERIODS: Final = 64
STRICT, LOOSE = 1e-6, 1e-3
"""Shares of what counts as one, by which sections of a period differ at most: of what is truly
periodic, and as the solver's verdicts say of themselves."""
UNCLEAR: Final = "unclear"


def period(sections: Floats, tolerance: Floats) -> int:
    """Return after how many sections all come back; 0: none up to 64."""
    for found in range(1, PERIODS + 1):
        rest = len(sections) // found * found
        turns = sections[len(sections) - rest :].reshape(-1, found, sections.shape[1])
        if (np.ptp(turns, axis=0) <= tolerance).all():
            return found
    return 0


def judged(sections: Floats, growth: Floats, scales: Floats, turns: bool) -> tuple[str, set[str]]:
    """Return the motion, and all the names by which a verdict is right.

    scales : what counts as one in each column. turns : the first one is an angle.
    """
    last = sections[-LOOKED_AT:].copy()
    if turns:
        last[:, 0] -= 2.0 * np.pi * np.round((last[:, 0] - last[0, 0]) / (2.0 * np.pi))
    strict = period(last, STRICT * scales)
    loose = period(last, LOOSE * np.maximum(np.ptp(last, axis=0), scales))
    parts = growth[len(growth) // 2 :].reshape(15, -1).mean(axis=1)
    mean, error = parts.mean(), parts.std(ddof=1) / np.sqrt(len(parts))
    if strict:
        return f"period-{strict}", {f"period-{strict}", f"period-{loose}"}
    if mean > max(5.0 * error, 1e-2):
        bands = {f"period-{loose}"} if loose else set()
        return "chaotic", {"chaotic", *bands}
    return UNCLEAR, set()
