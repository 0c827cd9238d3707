"""Extremes at corners and jumps of a function that can be evaluated at any instant.

A parabola through instants says nothing of them. A distance of points that pass one another has a
corner, a force of a driver whose acceleration jumps has a jump.
"""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats

SHARP = 1e-7
"""Share of a channel's range by which five instants of it may miss a parabola."""
ROUNDING = 1e-14
"""Share of the largest value of all channels that is nothing but rounding."""
NARROWINGS, INTO = 10, 8
"""Times that an interval is divided evenly, into how many parts, of which two are left: 4^-10."""
AT_ONCE = 100
"""Corners that are looked at together, each at `INTO` + 1 instants."""


def least_miss(values: Floats) -> Floats:
    """Return (channels,) by how much (..., channels) may miss a parabola and count as smooth."""
    flat = values.reshape(-1, values.shape[-1])
    found: Floats = SHARP * np.ptp(flat, axis=0) + ROUNDING * np.abs(flat).max(initial=0.0)
    return found


def misses(values: Floats) -> Floats:
    """Return by how much the five about each instant miss a parabola; values (bins, n, ...).

    0 for polynomials of the third degree; the first and the last two have the miss beside them.
    """
    count = values.shape[1]
    inner = np.abs(np.diff(values, 4, axis=1))
    return np.asarray(inner[:, np.clip(np.arange(count) - 2, 0, count - 5)], np.float64)


def surpass_at_corners(
    evaluate: Callable[[Floats], Floats],
    columns: Sequence[int],
    sampled: tuple[Floats, Floats],
    best: tuple[Floats, Floats],
    sense: float,
) -> None:
    """Replace largest (sense 1) or smallest (sense -1) values by those at corners and jumps.

    About every instant that is beyond those beside it, where the way to these might lead beyond
    the best: the highest corner need not be that of the highest instant.

    evaluate : gives (m, all channels) at (m,) s. columns : (k,) of the channels. sampled : times
    (bins, n), s, evenly spaced, and values (bins, n, k) there. best : values so far (bins, k) and
    their times, s; both are changed.
    """
    (times, values), (value, at) = sampled, best
    found = _corners(sense * values, sense * value, least_miss(values))
    for first in range(0, len(found), AT_ONCE):
        rows, bins, instants = found[first : first + AT_ONCE].T
        start = values[bins, instants, rows], times[bins, instants]
        reach, ends = times[bins, 1] - times[bins, 0], (times[bins, 0], times[bins, -1])
        top, when = narrowed(evaluate, np.take(columns, rows), start, reach, ends, sense)
        for index in np.argsort(-sense * top, kind="stable"):
            one = bins[index], rows[index]
            if sense * top[index] > sense * value[one]:
                value[one], at[one] = top[index], when[index]


def _corners(values: Floats, best: Floats, least: Floats) -> NDArray[np.int64]:
    """Return channel, bin and instant (m, 3) of those that may have a better corner beside them."""
    found = []
    for row in range(values.shape[-1]):  # one at a time: all at once take much memory
        own = values[..., row]
        sharp = misses(own) > least[row]
        if not sharp.any():
            continue
        rise = np.diff(own, axis=1)
        before, after = np.pad(rise, ((0, 0), (1, 0))), np.pad(-rise, ((0, 0), (0, 1)))
        beyond = (before >= 0.0) & (after >= 0.0) & sharp
        beyond &= own + np.maximum(before, after) > best[:, row, None]
        found += [(row, *index) for index in np.argwhere(beyond)]
    return np.array(found, dtype=np.int64).reshape(-1, 3)


def narrowed(
    evaluate: Callable[[Floats], Floats],
    columns: NDArray[np.int64],
    best: tuple[Floats, Floats],
    reach: Floats,
    ends: tuple[Floats, Floats],
    sense: float,
) -> tuple[Floats, Floats]:
    """Return extremes and their times near instants, at even ones about the best of all so far.

    columns : (k,) of channels. best : (k,) values so far, and their times, s. reach : (k,) s, how
    far to either side. ends : (k,) s, of what is looked at.
    """
    value, at = (one.copy() for one in best)
    shares, every = np.linspace(-1.0, 1.0, INTO + 1)[:, None], np.arange(len(columns))
    for _ in range(NARROWINGS):
        beside = np.clip(at + reach * shares, *ends)
        rows = evaluate(beside.ravel()).reshape(INTO + 1, len(columns), -1)[:, every, columns]
        highest = (sense * rows).argmax(axis=0)
        found = rows[highest, every]
        better = sense * found > sense * value
        value[better], at[better] = found[better], beside[highest, every][better]
        reach = reach * (2.0 / INTO)
    return value, at
