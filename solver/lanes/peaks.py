"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

from __future__ import annotations

import numpy as np

from solver.compiler.layout import LANES
from solver.compiler.slots import Slot
from solver.jit import LaneFunction, kernel
from solver.lanes.state import Counter, Setting

POINTS = LANES + 1
"""Quarters of the step before and of this one, and its end."""
WINDOW = 5


@kernel()
def refine_peaks(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    counters: np.ndarray,
    settings: np.ndarray,
    scratch: np.ndarray,
    lend: LaneFunction,
    probe_around: LaneFunction,
    right_hand_side: LaneFunction,
    observe: LaneFunction,
) -> None:
    """Seek the extremes that the scan suspects around the start of this step.

    Candidate channels are evaluated at quarters of the step before and of this one. A parabola
    through the best of them tells when, a quartic how much: the extreme is flat, so the parabola's
    error in time does not show. `scratch` has a row
    for the instants and one for each candidate, (rows + 1, POINTS + 1).
    """
    count = 0
    channel, rows = slots[Slot.CHANNEL] * LANES, slots[Slot.ROWS]
    for r in range(rows):
        if work[channel + r * LANES + lane] > 0.0:
            scratch[count + 1, POINTS] = r
            count += 1
    times = scratch[0]
    since = float(counters[Counter.PERIOD, lane]) * settings[Setting.PERIOD, lane]
    lend(work, spare, lane)
    probe_around(work, spare, lane)
    right_hand_side(spare)
    observe(spare)
    for i in range(LANES):
        times[i] = spare[slots[Slot.STAGE_TIME] * LANES + i]
    for n in range(count):
        row = (slots[Slot.CHANNEL] + int(scratch[n + 1, POINTS])) * LANES
        for i in range(LANES):
            scratch[n + 1, i] = spare[row + i]
    times[POINTS - 1] = work[slots[Slot.ARRIVAL] * LANES + lane]
    for n in range(count):
        values = scratch[n + 1]
        row = int(values[POINTS]) * LANES + lane
        values[POINTS - 1] = work[slots[Slot.PREVIOUS] * LANES + row]
        if values[LANES // 2] > values[0]:
            time, value = extreme(times, values, 1.0)
            if value > work[slots[Slot.HIGHEST] * LANES + row]:
                work[slots[Slot.HIGHEST] * LANES + row] = value
                work[slots[Slot.HIGHEST_TIME] * LANES + row] = since + time
        else:
            time, value = extreme(times, values, -1.0)
            if value < work[slots[Slot.LOWEST] * LANES + row]:
                work[slots[Slot.LOWEST] * LANES + row] = value
                work[slots[Slot.LOWEST_TIME] * LANES + row] = since + time


@kernel()
def extreme(times: np.ndarray, values: np.ndarray, sense: float) -> tuple[float, float]:
    """Time and value of the largest (sense 1) or smallest (sense -1) of POINTS sampled values."""
    last = POINTS - 1
    best = 0
    for i in range(1, last + 1):
        if sense * values[i] > sense * values[best]:
            best = i
    if best == 0 or best == last:
        return times[best], values[best]
    here = bend(times, values, best)
    left = bend(times, values, max(best - 1, 1))
    right = bend(times, values, min(best + 1, last - 1))
    smooth = sense * here < 0.0 and abs(left - here) + abs(right - here) < abs(here)
    if not smooth:  # a kink, as where friction reverses: no polynomial fits
        return corner(times, values, best, sense)
    after = times[best + 1] - times[best]
    slope = (values[best + 1] - values[best]) / after - here * after
    vertex = times[best] - 0.5 * slope / here
    if not times[best - 1] <= vertex <= times[best + 1]:
        return times[best], values[best]
    first = min(max(best - WINDOW // 2, 0), last + 1 - WINDOW)
    return vertex, interpolate(times, values, first, vertex)


@kernel()
def corner(times: np.ndarray, values: np.ndarray, best: int, sense: float) -> tuple[float, float]:
    """Time and value where two smooth pieces meet next to the best sample, or that sample itself.

    Each piece is continued by the parabola through its three samples nearest to the gap between
    two samples in which they meet.
    """
    time, value = times[best], values[best]
    for left in range(max(best - 1, 2), min(best, POINTS - 4) + 1):
        low, high = times[left], times[left + 1]
        rise = continued(times, values, left, -1, high) - values[left + 1]
        fall = values[left] - continued(times, values, left + 1, 1, low)
        if not sense * fall < 0.0 < sense * rise:
            continue
        at = low - fall * (high - low) / (rise - fall)
        before = continued(times, values, left, -1, at)
        after = continued(times, values, left + 1, 1, at)
        met = min(before, after) if sense > 0.0 else max(before, after)
        if sense * met > sense * value:
            time, value = at, met
    return time, value


@kernel()
def continued(times: np.ndarray, values: np.ndarray, i: int, side: int, at: float) -> float:
    """Value at an instant of the parabola through sample i and two more on one side (-1 or 1)."""
    first, second = i + side, i + 2 * side
    slope = (values[first] - values[i]) / (times[first] - times[i])
    next_slope = (values[second] - values[first]) / (times[second] - times[first])
    bent = (next_slope - slope) / (times[second] - times[i])
    return values[i] + (at - times[i]) * (slope + bent * (at - times[first]))


@kernel()
def interpolate(times: np.ndarray, values: np.ndarray, first: int, at: float) -> float:
    """Value at an instant of the polynomial through WINDOW samples from `first` (Lagrange)."""
    total = 0.0
    for i in range(first, first + WINDOW):
        above, below = values[i], 1.0
        for k in range(first, first + WINDOW):
            if k != i:
                above *= at - times[k]
                below *= times[i] - times[k]
        total += above / below
    return total


@kernel()
def bend(times: np.ndarray, values: np.ndarray, i: int) -> float:
    """Half the second derivative at sample i: the parabola through it and its neighbours."""
    left, right = times[i - 1] - times[i], times[i + 1] - times[i]
    down, up = values[i - 1] - values[i], values[i + 1] - values[i]
    return (up / right - down / left) / (right - left)


@kernel()
def end_peaks(lane: int, slots: np.ndarray, work: np.ndarray, now: float) -> None:
    """Let the values at the run's last instant count as extremes."""
    for r in range(slots[Slot.ROWS]):
        row = r * LANES + lane
        value = work[slots[Slot.PREVIOUS] * LANES + row]
        if value > work[slots[Slot.HIGHEST] * LANES + row]:
            work[slots[Slot.HIGHEST] * LANES + row] = value
            work[slots[Slot.HIGHEST_TIME] * LANES + row] = now
        if value < work[slots[Slot.LOWEST] * LANES + row]:
            work[slots[Slot.LOWEST] * LANES + row] = value
            work[slots[Slot.LOWEST_TIME] * LANES + row] = now
