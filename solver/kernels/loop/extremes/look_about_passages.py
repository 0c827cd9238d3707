"""Extremes where journals pass the centres of their bearings, and the normal whips round."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.even_instants import look_evenly
from jointplay.solver.kernels.loop.extremes.passages import (
    NARROWEST,
    Passage,
    closest_approach,
    is_through,
    orbiting_at_end,
    passes,
)
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.trace.rows import NO_ROW

SLACK = 0.1
"""Share of a journal's speed by which the slip at a passage may exceed what is expected."""
WIDTHS = 2.0
"""Widths of a passage to either side in which extremes are sought."""


@inner_kernel()
def look_about_passages(every: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of rows about all passages between two shares of the step."""
    for j in range(s.at.pairs):
        if passes(j, s):
            passage = closest_approach(j, s)
            if not is_through(passage, s):
                look_about(passage, every, low, high, s)


@inner_kernel()
def look_about_fast_passages(s: Step) -> None:
    """Seek extremes of slip and penetration where they may be beyond those so far.

    To be called while ``channel`` has the values at the step's end, before the scan.
    """
    lane, at, work = s.lane, s.at, s.work
    for j in range(at.pairs):
        if not passes(j, s):
            continue
        passage = closest_approach(j, s)
        if NARROWEST < passage.share < 1.0 - NARROWEST and may_be_fastest(j, passage, s):
            rows, count = np.empty(2, np.int64), 0
            slip = NO_ROW if is_through(passage, s) else work[at.slip_row + j, lane]
            for row in (slip, work[at.penetration_row + j, lane]):
                if row != NO_ROW:
                    rows[count] = int(row)
                    count += 1
            look_about(passage, rows[:count], 0.0, 1.0, s)


@inner_kernel()
def look_about(passage: Passage, rows: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of rows about one passage."""
    reach = WIDTHS * passage.width
    left, right = max(passage.share - reach, low), min(passage.share + reach, high)
    if left < right - NARROWEST:
        look_evenly(rows, left, right, s)


@inner_kernel()
def may_be_fastest(j: int, passage: Passage, s: Step) -> bool:
    """Whether a pair's slip or penetration may have a new extreme where it passes the centre.

    There the slip is that of the spins, as at the end of the step, and all of the journal's speed.
    """
    lane, at, work = s.lane, s.at, s.work
    slip, depth = int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])
    found = False
    if depth != NO_ROW:
        found |= passage.distance - work[at.inner + j, lane] < work[at.lowest + depth, lane]
    if slip != NO_ROW:
        spinning = work[at.channel + slip, lane] - orbiting_at_end(j, s)
        beyond = SLACK * passage.speed
        found |= spinning + passage.speed + beyond > work[at.highest + slip, lane]
        found |= spinning - passage.speed - beyond < work[at.lowest + slip, lane]
    return bool(found)
