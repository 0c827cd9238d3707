"""Extremes of a function that can be evaluated at any instant: sampled, then refined."""

from collections.abc import Callable, Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.quantities.corners import surpass_at_corners

REFINEMENTS = 3
"""Each parabola's vertex is evaluated and becomes the middle of one ten times narrower; the
error of a sampled smooth extreme falls to rounding in three."""


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
        better = sense * reached >= sense * value[going]
        value[going[better]], at[going[better]] = reached[better], refined[better]
        going = going[(at[going] != times[0]) & (at[going] != times[-1])]
        if not len(going):
            break
        middle[going], spacing = at[going], 0.1 * spacing
    surpass_at_corners(
        evaluate, channels, (times[None], values[None, :, channels]), (value[None], at[None]), sense
    )
    return value, at
