"""Extremes of a function that can be evaluated at any instant: sampled, then refined."""

from collections.abc import Callable, Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak

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
    peaks = {}
    for c, (name, column) in enumerate(zip(names, values.T, strict=True)):
        peaks[name] = sampled_peak(times, column)
        if peaks[name].minimum != peaks[name].maximum:
            low, high = (_refined(evaluate, c, times, column, sense) for sense in (-1.0, 1.0))
            peaks[name] = Peak(*low, *high)
    return peaks


def sampled_peak(times: Floats, values: Floats) -> Peak:
    """Return the extremes among (n,) samples."""
    low, high = int(values.argmin()), int(values.argmax())
    return Peak(float(values[low]), float(times[low]), float(values[high]), float(times[high]))


def _refined(
    evaluate: Callable[[Floats], Floats], channel: int, times: Floats, values: Floats, sense: float
) -> tuple[float, float]:
    """Return the largest (sense 1) or smallest (sense -1) value of a channel, and its time.

    Where that is an end, it may still be surpassed between this end and the instant beside it.
    """
    best = int((sense * values).argmax())
    at, value = float(times[best]), float(values[best])
    middle = float(times[min(max(best, 1), len(times) - 2)])
    spacing = float(times[1] - times[0])
    for _ in range(REFINEMENTS):
        around = np.clip(
            np.array([middle - spacing, middle, middle + spacing]), times[0], times[-1]
        )
        a, b, c = (float(x) for x in evaluate(around)[:, channel])
        curvature = a - 2.0 * b + c
        if curvature == 0.0:
            break
        vertex = middle + 0.5 * spacing * (a - c) / curvature
        refined = float(np.clip(vertex, times[0], times[-1]))
        reached = float(evaluate(np.array([refined]))[0, channel])
        if sense * reached >= sense * value:
            at, value = refined, reached
        if at in (times[0], times[-1]):
            break
        middle, spacing = at, 0.1 * spacing
    return value, at
