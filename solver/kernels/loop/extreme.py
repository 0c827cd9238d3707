"""The extreme of a function sampled at nine instants: Newton's divided differences, used twice.

A table has a row for the instants, rows for the inverses of their differences, which all channels
of a step share, a row for the values of one channel and rows for its divided differences.
"""

import numpy as np

from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.layout import INSTANTS

POINTS = INSTANTS + 1
"""Quarters of the step before and of this one, and its end."""
ORDER = 4
"""Order of the polynomial that gives an extreme's value."""
TINY = 1e-300
LEAST_SHRINKING = 0.1
STRIDE = 16
"""From a row of a table to the next."""
TIMES, INVERSES, VALUES = 0, 0, (ORDER + 1) * STRIDE
"""Where rows begin. Order k of the inverses is k rows behind INVERSES, of the divided differences
k rows behind VALUES; each belongs to the points from its place on."""
SHARES = 2 * (ORDER + 1) * STRIDE
"""Row for the places of the points, in shares of steps."""
WAITING, MOST_WAITING = SHARES + STRIDE, 32
"""Rows for values of channels whose extremes are to be zoomed in on; behind them the channel."""
SIZE = WAITING + MOST_WAITING * STRIDE


@kernel()
def compare_times(table: np.ndarray) -> None:
    """Fill in the inverses of the differences between instants."""
    for k in range(1, ORDER + 1):
        for i in range(POINTS - k):
            table[INVERSES + STRIDE * k + i] = 1.0 / (table[TIMES + i + k] - table[TIMES + i])


@kernel()
def compare_values(table: np.ndarray) -> None:
    """Fill in the divided differences of the values."""
    for k in range(1, ORDER + 1):
        for i in range(POINTS - k):
            risen = table[VALUES + STRIDE * (k - 1) + i + 1] - table[VALUES + STRIDE * (k - 1) + i]
            table[VALUES + STRIDE * k + i] = risen * table[INVERSES + STRIDE * k + i]


@kernel()
def extreme(table: np.ndarray, sense: float) -> tuple[float, float, float, int]:
    """Return the largest (sense 1) or smallest (sense -1) value near the samples: when, how much.

    A parabola through the best of them tells when, a quartic how much: the extreme is flat, so the
    parabola's error in time does not show. Then an estimate of the value's error, and the number of
    the best sample: the extreme is between its neighbours.
    """
    last = POINTS - 1
    best = 0
    for i in range(1, last + 1):
        if sense * table[VALUES + i] > sense * table[VALUES + best]:
            best = i
    time, value = table[TIMES + best], table[VALUES + best]
    if best == 0 or best == last:
        return time, value, 0.0, best
    bend = VALUES + 2 * STRIDE
    here = table[bend + best - 1]
    left = table[bend + max(best - 2, 0)]
    right = table[bend + min(best, last - 2)]
    smooth = sense * here < 0.0 and abs(left - here) + abs(right - here) < abs(here)
    if not smooth:  # a kink, as where friction reverses: no polynomial fits
        return corner(table, best, sense)
    after = table[TIMES + best + 1] - time
    slope = table[VALUES + STRIDE + best] - here * after
    vertex = time - 0.5 * slope / here
    if not table[TIMES + best - 1] <= vertex <= table[TIMES + best + 1]:
        return time, value, abs(here) * after * after, best
    first = min(max(best - ORDER // 2, 0), last - ORDER)
    total = table[VALUES + first]
    factor, term, before = 1.0, 0.0, 0.0
    for k in range(1, ORDER + 1):
        factor *= vertex - table[TIMES + first + k - 1]
        before, term = term, factor * table[VALUES + STRIDE * k + first]
        total += term
    # terms left out shrink as the last ones did, but one may be small by chance
    shrinking = min(max(abs(term) / (abs(before) + TINY), LEAST_SHRINKING), 1.0)
    return vertex, total, shrinking * abs(term), best


@kernel()
def corner(table: np.ndarray, best: int, sense: float) -> tuple[float, float, float, int]:
    """Return as `extreme` where two smooth pieces meet next to the best sample, or that sample.

    Each piece is continued by the parabola through its three samples nearest to the gap between
    two samples in which they meet. The error is what the parabolas are bent there.
    """
    time, value = table[TIMES + best], table[VALUES + best]
    if value == table[VALUES + best + 1]:  # it rests there
        return time, value, 0.0, best
    error = max(abs(value - table[VALUES + best - 1]), abs(value - table[VALUES + best + 1]))
    for left in range(max(best - 1, 2), min(best, POINTS - 4) + 1):
        low, high = table[TIMES + left], table[TIMES + left + 1]
        rise = from_left(table, left, high) - table[VALUES + left + 1]
        fall = table[VALUES + left] - from_right(table, left + 1, low)
        if not sense * fall < 0.0 < sense * rise:
            continue
        at = low - fall * (high - low) / (rise - fall)
        before, after = from_left(table, left, at), from_right(table, left + 1, at)
        met = min(before, after) if sense > 0.0 else max(before, after)
        if sense * met > sense * value:
            time, value = at, met
            bends = abs(table[VALUES + 2 * STRIDE + left - 2])
            bends += abs(table[VALUES + 2 * STRIDE + left + 1])
            error = abs(before - after) + bends * (high - low) * (high - low)
    return time, value, error, best


@kernel()
def from_left(table: np.ndarray, i: int, at: float) -> float:
    """Value at an instant of the parabola through sample i and the two before."""
    bent = (at - table[TIMES + i - 1]) * table[VALUES + 2 * STRIDE + i - 2]
    rise: float = table[VALUES + i] + (at - table[TIMES + i]) * (
        table[VALUES + STRIDE + i - 1] + bent
    )
    return rise


@kernel()
def from_right(table: np.ndarray, i: int, at: float) -> float:
    """Value at an instant of the parabola through sample i and the two behind."""
    bent = (at - table[TIMES + i + 1]) * table[VALUES + 2 * STRIDE + i]
    rise: float = table[VALUES + i] + (at - table[TIMES + i]) * (table[VALUES + STRIDE + i] + bent)
    return rise
