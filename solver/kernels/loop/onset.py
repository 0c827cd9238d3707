"""Finds where inside a step a gap closes, on the dense output."""

import math

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import INSTANTS

NO_ONSET = math.inf
NEWTON_STEPS = 2


@kernel()
def look_between(
    low: float,
    high: float,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> None:
    """Evaluate all gaps at eight equal distances from one share of the step to another."""
    for i in range(INSTANTS):
        spare[at.theta, i] = low + (high - low) * (i + 1) / INSTANTS
    gaps_within(work, spare, lane)


@kernel()
def first_onset(
    j: int,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> float:
    """Return the share of the step after which joint j's gap first closes, `NO_ONSET` if never.

    The gap is looked at in eight places; where its rate turns between two of them without the gap
    closing, the turning point is looked at more closely (a grazing contact).
    """
    low, high = 0.0, 1.0
    for level in range(4):
        look_between(low, high, lane, at, work, spare, gaps_within)
        before_rate = work[at.gap_rate_start + j, lane] if level == 0 else 1.0
        turning = -1
        for i in range(INSTANTS):
            gap, rate = spare[at.gap + j, i], spare[at.gap_rate + j, i]
            if gap > 0.0:
                left = low + (high - low) * i / INSTANTS
                right = low + (high - low) * (i + 1) / INSTANTS
                return polish(j, left, right, lane, at, work, spare, gaps_within)
            if before_rate > 0.0 and rate < 0.0:
                turning = i
            before_rate = rate
        if turning < 0:
            return NO_ONSET
        width = (high - low) / INSTANTS
        low = low + width * turning
        high = low + width
    return NO_ONSET


@kernel()
def polish(
    j: int,
    left: float,
    right: float,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
) -> float:
    """Return the root of joint j's gap in a bracket: sectioning, then Newton inside the bracket."""
    tried = work[at.tried, lane]
    root = right
    look_between(left, right, lane, at, work, spare, gaps_within)
    for i in range(INSTANTS):
        if spare[at.gap + j, i] > 0.0:
            right = spare[at.theta, i]
            left = right - (right - left) / INSTANTS if i == 0 else spare[at.theta, i - 1]
            gap, rate = spare[at.gap + j, i], spare[at.gap_rate + j, i]
            root = right - gap / (rate * tried) if rate > 0.0 else right
            root = min(max(root, left), right)
            break
    for _ in range(NEWTON_STEPS):
        spare[at.theta, 0] = root
        gaps_within(work, spare, lane)
        gap, rate = spare[at.gap + j, 0], spare[at.gap_rate + j, 0]
        better = root - gap / (rate * tried) if rate > 0.0 else root
        if left <= better <= right:
            root = better
    return root
