"""Extremes of a function that can be evaluated at any instant: sampled, then refined."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak

REFINEMENTS = 3
"""Each parabola's vertex is evaluated and becomes the middle of one ten times narrower; the
error of a sampled smooth extreme falls to rounding in three."""
SHARP = 1e-7
"""Share of a channel's range by which a parabola's vertex may miss it."""
ROUNDING = 1e-14
"""Share of the largest value of all channels that is nothing but rounding."""
NARROWINGS, INTO = 10, 8
"""Times that an interval is divided evenly, into how many parts, of which two are left: 4^-10."""


def refined_peaks(
    names: Sequence[str], evaluate: Callable[[Floats], Floats], times: Floats, values: Floats
) -> dict[str, Peak]:
    """Return the extremes of channels by name, to rounding where they are smooth.

    times : (n,) equally spaced, s. values : (n, channels) sampled there; `evaluate` gives such
    at any times.
    """
    columns = zip(names, values.T, strict=True)
    peaks = {name: sampled_peak(times, column) for name, column in columns}
    moving = [c for c, peak in enumerate(peaks.values()) if peak.minimum != peak.maximum]
    if moving:
        found = [_refined(evaluate, moving, times, values, sense) for sense in (-1.0, 1.0)]
        for c, *extremes in zip(moving, *found[0], *found[1], strict=True):
            peaks[names[c]] = Peak(*(float(one) for one in extremes))
    return peaks


def sampled_peak(times: Floats, values: Floats) -> Peak:
    """Return the extremes among (n,) samples."""
    low, high = int(values.argmin()), int(values.argmax())
    return Peak(float(values[low]), float(times[low]), float(values[high]), float(times[high]))


def _refined(
    evaluate: Callable[[Floats], Floats],
    channels: Sequence[int],
    times: Floats,
    values: Floats,
    sense: float,
) -> tuple[Floats, Floats]:
    """Return the largest (sense 1) or smallest (sense -1) values of channels, and their times.

    Where that is an end, it may still be surpassed between this end and the instant beside it.
    All channels are looked at together: an evaluation takes as long for one as for many.
    """
    best = (sense * values[:, channels]).argmax(axis=0)
    least, sharp = least_miss(values[:, channels]), np.zeros(len(channels), np.bool_)
    value, at = values[best, channels], times[best]
    middle, spacing = times[np.clip(best, 1, len(times) - 2)], float(times[1] - times[0])
    going = np.arange(len(channels))  # those whose extremes may still be surpassed
    for _ in range(REFINEMENTS):
        column, count = np.take(channels, going), len(going)
        beside = middle[going] + spacing * np.array([[-1.0], [0.0], [1.0]])
        around = np.clip(beside, times[0], times[-1]).ravel()
        rows = evaluate(around).reshape(3, count, -1)
        a, b, c = rows[:, np.arange(count), column]
        curvature = a - 2.0 * b + c
        bent = curvature != 0.0
        going, column = going[bent], column[bent]
        if not len(going):
            break
        vertex = middle[going] + 0.5 * spacing * (a - c)[bent] / curvature[bent]
        refined = np.clip(vertex, times[0], times[-1])
        reached = evaluate(refined)[np.arange(len(going)), column]
        top = (b - 0.125 * (a - c) ** 2 / np.where(bent, curvature, 1.0))[bent]
        sharp[going] |= (refined == vertex) & (abs(reached - top) > least[going])
        better = sense * reached >= sense * value[going]
        value[going[better]], at[going[better]] = reached[better], refined[better]
        going = going[(at[going] != times[0]) & (at[going] != times[-1])]
        if not len(going):
            break
        middle[going], spacing = at[going], 0.1 * spacing
    if sharp.any():
        column, ends = np.take(channels, sharp.nonzero()[0]), (times[0], times[-1])
        best = best[sharp]
        start = values[best, column], times[best]
        value[sharp], at[sharp] = narrowed(
            evaluate, column, start, times[1] - times[0], ends, sense
        )
    return value, at


def least_miss(values: Floats) -> Floats:
    """Return (channels,) by how much (n, channels) may miss a parabola and count as smooth."""
    found: Floats = SHARP * np.ptp(values, axis=0) + ROUNDING * np.abs(values).max(initial=0.0)
    return found


def narrowed(
    evaluate: Callable[[Floats], Floats],
    columns: NDArray[np.int64],
    best: tuple[Floats, Floats],
    reach: float,
    ends: tuple[Floats | float, Floats | float],
    sense: float,
) -> tuple[Floats, Floats]:
    """Return extremes and their times where channels have corners, or all but have them.

    At even instants about the best of all, and then about the best of these. A distance of points
    that pass one another has such a minimum.

    columns : (k,) of channels. best : (k,) values so far, and their times, s. reach : s, how far
    to either side. ends : s, of what is looked at.
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
        reach *= 2.0 / INTO
    return value, at
