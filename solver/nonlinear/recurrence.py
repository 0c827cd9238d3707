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
    its bands: the tolerance is part of the statement. There is none while points may still come as
    far as a tenth of the distance between those of a shorter period (see `still_to_come`): of a
    swing that dies out with half the frequency, two sections differ ever less, and more slowly than
    the tolerance tells. Nor is there while that distance grows.

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
            return period if _apart_for_good(scaled, period) else 0
    return 0


FAR_CLOSER, SAME = 0.03, 1e-3
"""Shares of the tolerance within which chaos hardly recurs by chance, in however few sections, and
within which it does not even if neighbours seem to part, as in steady rotation."""
PARTING = 1.5
"""Factor by which distances of points a period apart grow, from the first half of a record to the
last, as they do in chaos that passes an unstable orbit; noise of few points may do so, too."""


PARTED = 0.5
"""Logarithm of the growth over whole orbits from which on neighbours part, even if their exponent
is too uncertain to tell: chaos that comes back for a while has more, a stable orbit has none."""


def may_recur_by_chance(
    points: Floats, period: int, tolerance: float, growth: float | None = None
) -> bool:
    """Return whether (n, d) points that have a period within a tolerance may be chaotic.

    Where chaos comes close to where it was, or passes an unstable orbit, sections recur for a
    while: of some thousands of short records one does. Then neighbours part. `growth` is the
    logarithm of that over the last whole orbits; None: not known. Then points must not part, by the
    medians of distances over the first and the last half, and three turns must show that. Points
    within 3 % of the tolerance do not recur by chance.
    """
    extent = largest_extent(points, period)
    if growth is not None:
        return growth > PARTED and extent > SAME * tolerance
    if extent <= FAR_CLOSER * tolerance:
        return False
    if len(points) < 3 * period:
        return True
    apart = np.abs(points[period:] - points[:-period]).max(axis=1)
    half = (len(apart) + 1) // 2
    return bool(np.median(apart[-half:]) > PARTING * np.median(apart[:half]))


SLOWEST = 0.99
"""Largest q, of changes over a third of a record: more is indistinguishable from noise."""
KEPT = 0.1
"""Largest share of a distance that points may still move for the distance to stay. Points on both
sides of one that they converge to, at any rate, still have half of it to go; where a multiplier is
-1 distances die out like the root of time, and a sixth of them seems to be left."""


def still_to_come(points: Floats, period: int) -> float:
    """Return how far (n, d) points a period apart will still move, if they converge geometrically.

    The change over the last third of the record is q times that over the third before: q/(1 - q) of
    it are left. Periods too long for three thirds count as converging at the slowest.
    """
    turn = period * max(len(points) // (3 * period), 1)
    last = points[len(points) - period :]
    if len(points) < 2 * turn + period:
        before = last - points[len(points) - turn - period : len(points) - turn]
        return float(np.abs(before).max()) * SLOWEST / (1.0 - SLOWEST)
    middle = points[len(points) - period - turn : len(points) - turn]
    first = points[len(points) - period - 2 * turn : len(points) - 2 * turn]
    change, earlier = float(np.abs(last - middle).max()), float(np.abs(middle - first).max())
    if change == 0.0:
        return 0.0
    ratio = min(change / earlier, SLOWEST) if earlier > 0.0 else SLOWEST
    return change * ratio / (1.0 - ratio)


CREEPS = 0.75
"""Share of its way that what moves in one sense is away from where it began; noise comes back."""


def creep_to_come(points: Floats, period: int) -> float:
    """Return what is `still_to_come` of (n, d) points in those columns that move in one sense."""
    turns = len(points) // period
    whole = points[len(points) - turns * period :].reshape(turns, period, -1)
    gone = np.abs(whole[-1] - whole[0])
    way = np.abs(np.diff(whole, axis=0)).sum(axis=0)
    creeping = ((gone >= CREEPS * way) & (gone > 0.0)).any(axis=0)
    return still_to_come(points[:, creeping], period) if creeping.any() else 0.0


def _apart_for_good(points: Floats, period: int) -> bool:
    """Return whether points that a part of the period lies between stay apart."""
    parts = [k for k in range(2, period + 1) if period % k == 0 and _is_prime(k)]
    if not parts:
        return True
    coming = still_to_come(points, period)
    last = points[len(points) - period :]
    for shorter in (period // part for part in parts):
        before = points[len(points) - period - shorter : len(points) - shorter]
        if coming > KEPT * float(np.abs(last - before).max()):
            return False
    return True


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


FADES = 0.7
"""Share of their extent in the first half of a record below which points of the last half have come
closer to where they go."""
ORDER = 0.1
"""Share of their own extent within which points recur that move in some order."""


def moves_within(points: Floats, tolerance: float) -> bool:
    """Return whether (n, d) points that are all the same within a tolerance go on to move in it.

    They do where their extent is more than 3 % of it, does not fade from the first half of the
    record to the last, and nothing recurs within a tenth of it: chaos that is small beside what
    counts as one looks like that, and so does noise. Fewer than twelve points do not tell.
    """
    extent, half = np.ptp(points, axis=0), len(points) // 2
    largest = float(extent.max(initial=0.0))
    if len(points) < FEWEST_LEAVING or not FAR_CLOSER * tolerance < largest <= tolerance:
        return False
    own = points / np.maximum(extent, ORDER * largest)
    first, last = largest_extent(own[:half], 1), largest_extent(own[-half:], 1)
    return last > FADES * first and not recurrence_period(own, np.ones(len(extent)), ORDER)


LEAVES = 30.0
"""Factor by which sections that leave an orbit part at least, from the first third of a record to
the last. Of random chaos one record in forty does by chance, of 18 to 50 sections."""
FEWEST_LEAVING = 12


def leaves_an_orbit(points: Floats) -> bool:
    """Return whether (n, d) points leave an unstable orbit of up to four points.

    Then those a period apart lie ever farther apart, as neighbours do: by the median of the last
    third over that of the first. In chaos neighbours part, but such distances come and go. Fewer
    than twelve points do not tell.
    """
    third = len(points) // 3
    if len(points) < FEWEST_LEAVING:
        return False
    for period in range(1, min(TWICE, third - 1) + 1):
        apart = np.abs(points[period:] - points[:-period]).max(axis=1)
        early, late = (
            np.median(part) for part in (apart[: third - period], apart[period - third :])
        )
        if late > LEAVES * early:
            return True
    return False
