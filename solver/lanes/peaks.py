"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

from __future__ import annotations

import numpy as np

from solver.compiler.layout import LANES
from solver.compiler.slots import Slots
from solver.jit import kernel
from solver.lanes.state import Counter, Setting
from solver.lanes.onset import dense

POINTS = 2 * LANES + 1


@kernel()
def refine_peaks(
    l: int,
    slots: Slots,
    work: np.ndarray,
    spare: np.ndarray,
    counters: np.ndarray,
    settings: np.ndarray,
    probe: object,
    probe_before: object,
    right_hand_side: object,
    observe: object,
) -> None:
    """Seek the extremes that the scan suspects around the start of this step of lane l.

    Candidate channels are evaluated at eight instants in the step before and eight in this one; a
    parabola through the best of them and its neighbours gives the extreme.
    """
    times = np.empty(POINTS)
    values = np.empty((slots.rows, POINTS))
    since = float(counters[Counter.PERIOD, l]) * settings[Setting.PERIOD, l]
    times[0] = work[slots.before_time * LANES + l]
    for r in range(slots.rows):
        row = r * LANES + l
        previous = work[slots.previous * LANES + row]
        values[r, 0] = previous - work[slots.change * LANES + row]
    for half in range(2):
        for i in range(LANES):
            spare[slots.theta * LANES + i] = (i + 1) / LANES
        if half == 0:
            dense(l, slots, work, spare, probe_before, right_hand_side)
        else:
            dense(l, slots, work, spare, probe, right_hand_side)
        observe(spare)
        for i in range(LANES):
            times[half * LANES + i + 1] = spare[slots.stage_time * LANES + i]
        for r in range(slots.rows):
            for i in range(LANES):
                values[r, half * LANES + i + 1] = spare[(slots.channel + r) * LANES + i]
    for r in range(slots.rows):
        row = r * LANES + l
        if not work[slots.candidate * LANES + row] > 0.0:
            continue
        if work[slots.change * LANES + row] > 0.0:
            time, value = extreme(times, values[r], 1.0)
            if value > work[slots.highest * LANES + row]:
                work[slots.highest * LANES + row] = value
                work[slots.highest_time * LANES + row] = since + time
        else:
            time, value = extreme(times, values[r], -1.0)
            if value < work[slots.lowest * LANES + row]:
                work[slots.lowest * LANES + row] = value
                work[slots.lowest_time * LANES + row] = since + time


@kernel()
def extreme(times: np.ndarray, values: np.ndarray, sense: float) -> tuple[float, float]:
    """Time and value of the largest (sense 1) or smallest (sense -1) of sampled values."""
    best = 0
    for i in range(1, len(values)):
        if sense * values[i] > sense * values[best]:
            best = i
    if best == 0 or best == len(values) - 1:
        return times[best], values[best]
    left, right = times[best - 1] - times[best], times[best + 1] - times[best]
    if not (left < 0.0 < right):
        return times[best], values[best]
    down, up = values[best - 1] - values[best], values[best + 1] - values[best]
    curvature = (up / right - down / left) / (right - left)
    slope = up / right - curvature * right
    if curvature == 0.0:
        return times[best], values[best]
    shift = -0.5 * slope / curvature
    if not left <= shift <= right:
        return times[best], values[best]
    return times[best] + shift, values[best] + 0.5 * slope * shift


@kernel()
def end_peaks(l: int, slots: Slots, work: np.ndarray, now: float) -> None:
    """Let the values at the run's last instant count as extremes."""
    for r in range(slots.rows):
        row = r * LANES + l
        value = work[slots.channel * LANES + row]
        if value > work[slots.highest * LANES + row]:
            work[slots.highest * LANES + row] = value
            work[slots.highest_time * LANES + row] = now
        if value < work[slots.lowest * LANES + row]:
            work[slots.lowest * LANES + row] = value
            work[slots.lowest_time * LANES + row] = now
