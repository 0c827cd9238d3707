"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

from __future__ import annotations

import numpy as np

from solver.compiler.layout import LANES
from solver.compiler.slots import Slot
from solver.jit import LaneFunction, kernel
from solver.lanes.onset import dense
from solver.lanes.state import Counter, Setting

POINTS = 2 * LANES + 1


@kernel()
def refine_peaks(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    counters: np.ndarray,
    settings: np.ndarray,
    lend: LaneFunction,
    probe: LaneFunction,
    probe_before: LaneFunction,
    right_hand_side: LaneFunction,
    observe: LaneFunction,
) -> None:
    """Seek the extremes that the scan suspects around the start of this step of lane lane.

    Candidate channels are evaluated at eight instants in the step before and eight in this one; a
    parabola through the best of them and its neighbours gives the extreme.
    """
    rows = np.empty(slots[Slot.ROWS], dtype=np.int64)
    count = 0
    for r in range(slots[Slot.ROWS]):
        if work[(slots[Slot.CANDIDATE] + r) * LANES + lane] > 0.0:
            rows[count] = r
            count += 1
    times = np.empty(POINTS)
    values = np.empty((count, POINTS))
    since = float(counters[Counter.PERIOD, lane]) * settings[Setting.PERIOD, lane]
    for half in range(2):
        for i in range(LANES):
            spare[slots[Slot.THETA] * LANES + i] = i / LANES
        chosen = probe_before if half == 0 else probe
        dense(lane, work, spare, lend, chosen, right_hand_side)
        observe(spare)
        for i in range(LANES):
            times[half * LANES + i] = spare[slots[Slot.STAGE_TIME] * LANES + i]
            for n in range(count):
                values[n, half * LANES + i] = spare[(slots[Slot.CHANNEL] + rows[n]) * LANES + i]
    times[POINTS - 1] = work[slots[Slot.ARRIVAL] * LANES + lane]
    for n in range(count):
        row = rows[n] * LANES + lane
        values[n, POINTS - 1] = work[slots[Slot.CHANNEL] * LANES + row]
        time, value = extreme(times, values[n], 1.0)
        if value > work[slots[Slot.HIGHEST] * LANES + row]:
            work[slots[Slot.HIGHEST] * LANES + row] = value
            work[slots[Slot.HIGHEST_TIME] * LANES + row] = since + time
        time, value = extreme(times, values[n], -1.0)
        if value < work[slots[Slot.LOWEST] * LANES + row]:
            work[slots[Slot.LOWEST] * LANES + row] = value
            work[slots[Slot.LOWEST_TIME] * LANES + row] = since + time


@kernel()
def extreme(times: np.ndarray, values: np.ndarray, sense: float) -> tuple[float, float]:
    """Time and value of the largest (sense 1) or smallest (sense -1) of sampled values."""
    last = len(values) - 1
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
    if not smooth:  # a kink, as where contact ends: no parabola fits, and none is needed
        return times[best], values[best]
    after = times[best + 1] - times[best]
    slope = (values[best + 1] - values[best]) / after - here * after
    shift = -0.5 * slope / here
    if not times[best - 1] - times[best] <= shift <= after:
        return times[best], values[best]
    return times[best] + shift, values[best] + 0.5 * slope * shift


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
        value = work[slots[Slot.CHANNEL] * LANES + row]
        if value > work[slots[Slot.HIGHEST] * LANES + row]:
            work[slots[Slot.HIGHEST] * LANES + row] = value
            work[slots[Slot.HIGHEST_TIME] * LANES + row] = now
        if value < work[slots[Slot.LOWEST] * LANES + row]:
            work[slots[Slot.LOWEST] * LANES + row] = value
            work[slots[Slot.LOWEST_TIME] * LANES + row] = now
