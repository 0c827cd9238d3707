"""Finds where inside a step a gap closes, on the dense output."""

from __future__ import annotations

import math

import numpy as np

from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.slots import Slot

NO_ONSET = math.inf
NEWTON_STEPS = 2


@kernel()
def look_between(
    low: float,
    high: float,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> None:
    """Evaluate all gaps at eight equal distances from one share of the step to another."""
    for i in range(LANES):
        spare[slots[Slot.THETA] * LANES + i] = low + (high - low) * (i + 1) / LANES
    gaps_within(work, spare, lane)


@kernel()
def first_onset(
    j: int,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> float:
    """Return the share of the step after which joint j's gap first closes; infinite: it does not.

    The gap is looked at in eight places; where its rate turns between two of them without the gap
    closing, the turning point is looked at more closely (a grazing contact).
    """
    low, high = 0.0, 1.0
    gap_slot, rate_slot = slots[Slot.GAP] + 4 * j, slots[Slot.GAP] + 4 * j + 1
    for level in range(4):
        look_between(low, high, lane, slots, work, spare, gaps_within)
        before_rate = work[(gap_slot + 3) * LANES + lane] if level == 0 else 1.0
        turning = -1
        for i in range(LANES):
            gap, rate = spare[gap_slot * LANES + i], spare[rate_slot * LANES + i]
            if gap > 0.0:
                left = low + (high - low) * i / LANES
                right = low + (high - low) * (i + 1) / LANES
                return polish(j, left, right, lane, slots, work, spare, gaps_within)
            if before_rate > 0.0 and rate < 0.0:
                turning = i
            before_rate = rate
        if turning < 0:
            return NO_ONSET
        width = (high - low) / LANES
        low = low + width * turning
        high = low + width
    return NO_ONSET


@kernel()
def polish(
    j: int,
    left: float,
    right: float,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> float:
    """Return the root of joint j's gap in a bracket: sectioning, then Newton inside the bracket."""
    gap_slot, rate_slot = slots[Slot.GAP] + 4 * j, slots[Slot.GAP] + 4 * j + 1
    tried = work[slots[Slot.TRIED] * LANES + lane]
    root = right
    theta = slots[Slot.THETA] * LANES
    look_between(left, right, lane, slots, work, spare, gaps_within)
    for i in range(LANES):
        if spare[gap_slot * LANES + i] > 0.0:
            right = spare[theta + i]
            left = right - (right - left) / LANES if i == 0 else spare[theta + i - 1]
            gap, rate = spare[gap_slot * LANES + i], spare[rate_slot * LANES + i]
            root = right - gap / (rate * tried) if rate > 0.0 else right
            root = min(max(root, left), right)
            break
    for _ in range(NEWTON_STEPS):
        spare[theta] = root
        gaps_within(work, spare, lane)
        gap, rate = spare[gap_slot * LANES], spare[rate_slot * LANES]
        better = root - gap / (rate * tried) if rate > 0.0 else root
        if left <= better <= right:
            root = better
    return root
