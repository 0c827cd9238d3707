"""The period of a motion, seen on its section."""

import numpy as np

from jointplay.records.arrays import Floats

LONGEST = 32
TWICE = 4
"""Longest period that two turns show; longer ones need three: of a chaotic motion that comes close
to where it was, what follows stays close for a while."""


def longest_in(sections: int, longest: int = LONGEST) -> int:
    """Return the longest period that is looked for among so many sections."""
    return min(longest, max(min(sections // 2, TWICE), sections // 3))


def recurrence_period(
    section: Floats, scale: Floats, tolerance: float, longest: int = LONGEST
) -> int:
    """Return the smallest p such that every p-th section is the same throughout; 0: there is none.

    section : (n, d) points in time; at least three turns must be on record, so p ≤ n/3, or two of a
    period of at most four.
    scale : (d,) what counts as one in each column, positive.
    tolerance : largest extent, in units of `scale`, of the points i, i + p, i + 2p …; well above
        the error of the integration, well below the motion. Points that creep along a curve by less
        than the tolerance a turn therefore do not recur.
    longest : longest period looked for.

    A constant section has period 1. A chaotic band narrower than the tolerance has the period of
    its bands: the tolerance is part of the statement. There is none while points of a shorter
    period still come closer to one another: behind a doubling, the halves of a period of two differ
    ever less, and more slowly than the tolerance tells.

    Raises
    ------
    ValueError
        If a scale is not positive, the tolerance negative, or a point not finite.
    """
    points = np.asarray(section, np.float64)
    if points.ndim != 2 or np.shape(scale) != (points.shape[1],):
        raise ValueError("a section is (n, d), its scale (d,)")
    if not (np.asarray(scale) > 0.0).all() or not tolerance >= 0.0:
        raise ValueError("scales must be positive and the tolerance not negative")
    if not np.isfinite(points).all():
        raise ValueError("recurrence needs finite points; leave out sections never reached")
    scaled = points / scale
    for period in range(1, longest_in(len(points), longest) + 1):
        if largest_extent(scaled, period) <= tolerance:
            return 0 if _still_close_in(scaled, period) else period
    return 0


SHRINKS = 0.9
"""Distance of points of a shorter period at the end of a section, over that at its beginning, below
which they still come closer; in the mean of a period."""


def _still_close_in(points: Floats, period: int) -> bool:
    """Return whether points that a part of the period lies between still come closer."""
    parts = [k for k in range(2, period + 1) if period % k == 0 and _is_prime(k)]
    for shorter in (period // part for part in parts):
        distances = np.abs(points[shorter:] - points[:-shorter]).max(axis=1)
        if len(distances) < 2 * period:
            continue
        if distances[-period:].mean() < SHRINKS * distances[:period].mean():
            return True
    return False


def _is_prime(number: int) -> bool:
    return all(number % k for k in range(2, number))


def largest_extent(points: Floats, period: int) -> float:
    """Return the largest extent in any column of (n, d) points that are a period apart."""
    n, columns = points.shape
    turns = n // period
    whole = points[: turns * period].reshape(turns, period, columns)
    lowest, highest = whole.min(axis=0), whole.max(axis=0)
    rest = points[turns * period :]
    lowest[: len(rest)] = np.minimum(lowest[: len(rest)], rest)
    highest[: len(rest)] = np.maximum(highest[: len(rest)], rest)
    return float((highest - lowest).max(initial=0.0))
