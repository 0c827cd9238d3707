"""Extremes of a function that can be evaluated at any instant: sampled, then refined."""

from collections.abc import Callable

import numpy as np

from jointplay.records.arrays import Floats

REFINEMENTS = 3
"""Each parabola's vertex is evaluated and becomes the middle of one ten times narrower; the
error of a sampled smooth extreme falls to rounding in three."""


def refine_extreme(
    evaluate: Callable[[Floats], Floats], times: Floats, values: Floats, sense: float
) -> tuple[float, float]:
    """Return time and value of the largest (sense 1) or smallest (sense -1) value.

    times, values : (n,) samples, equally spaced in s; `evaluate` maps times to values.
    """
    best = int((sense * values).argmax())
    at, value = float(times[best]), float(values[best])
    spacing = float(times[1] - times[0])
    for _ in range(REFINEMENTS):
        if at in (times[0], times[-1]):
            break
        around = np.clip(np.array([at - spacing, at, at + spacing]), times[0], times[-1])
        a, b, c = (float(x) for x in evaluate(around))
        curvature = a - 2.0 * b + c
        if curvature == 0.0:
            break
        vertex = at + 0.5 * spacing * (a - c) / curvature
        refined = float(np.clip(vertex, times[0], times[-1]))
        reached = float(evaluate(np.array([refined]))[0])
        if sense * reached >= sense * value:
            at, value = refined, reached
        spacing *= 0.1
    return at, value
