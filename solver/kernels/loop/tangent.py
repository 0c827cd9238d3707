"""Tangent vectors of lanes: their start, their jump where a contact begins, their growth."""

from __future__ import annotations

import math

import numpy as np

from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.state import Counter
from jointplay.solver.kernels.slots import Slot

GOLDEN = 0.6180339887498949
"""Its multiples less their whole parts are unrelated: a direction that no symmetry singles out."""
SHORTEST = 1e-290
"""Length below which a tangent counts as vanished: its inverse would overflow."""


@kernel()
def start_tangent(lane: int, slots: np.ndarray, work: np.ndarray) -> None:
    """Give a lane a tangent of length 1 that has a share of every coordinate and speed."""
    for i in range(slots[Slot.STATES]):
        share = (i + 1) * GOLDEN - math.floor((i + 1) * GOLDEN) + 0.5
        weight = work[(slots[Slot.WEIGHT] + i) * LANES + lane]
        work[(slots[Slot.TANGENT] + i) * LANES + lane] = share / weight
    for j in range(slots[Slot.JOINTS]):
        work[(slots[Slot.TANGENT_IMPACT_RATE] + j) * LANES + lane] = 0.0
    scale_tangent(1.0 / tangent_length(lane, slots, work), lane, slots, work)


@kernel()
def latch_tangent(j: int, lane: int, slots: np.ndarray, work: np.ndarray) -> None:
    """Give the latched impact rate of joint j its derivative along the tangent.

    To be called once `begin_contact` has latched the rate and `tangent_gaps` was evaluated at the
    same state. A neighbouring run has its onset later by dt = -dδ / δ̇, so it latches
    dδ̇ + δ̈ dt more; a floored rate is the same for all neighbours.

    The tangent of the state itself does not jump (its saltation matrix, Müller 1995, is the
    identity): that matrix is I + (f_after - f_before) ⊗ ∇δ / δ̇, and a contact law whose force
    grows from zero at δ = 0, K δ^n with n >= 1 and friction proportional to it, makes the slope f
    continuous there. The same holds where contact ends. It fails for a law whose force jumps at
    touch, such as a viscous damper without the factor δ^n. Friction with equal limit velocities
    jumps, too, but where the slip reverses, which is no onset; a run with such friction has no
    tangent (`solver.kernels.loop.beginning`).
    """
    gap_slot = slots[Slot.GAP] + 4 * j
    tangent_slot = slots[Slot.TANGENT_GAP] + 3 * j
    rate = work[(gap_slot + 1) * LANES + lane]
    latched = 0.0
    if rate > work[(slots[Slot.IMPACT_FLOOR] + j) * LANES + lane]:
        later = -work[tangent_slot * LANES + lane] / rate
        latched = work[(tangent_slot + 1) * LANES + lane]
        latched += work[(tangent_slot + 2) * LANES + lane] * later
    work[(slots[Slot.TANGENT_IMPACT_RATE] + j) * LANES + lane] = latched


@kernel()
def record_growth(
    now: float,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    counters: np.ndarray,
    growth_rows: np.ndarray,
) -> bool:
    """Hand out by how much a lane's tangent grew since the row before; whether that was the last.

    A row is the time of its end, s since the start, and the logarithm of the growth.
    """
    row = growth_rows[lane, counters[Counter.GROWTH_ROWS, lane]]
    row[0] = now
    row[1] = renormalise(lane, slots, work)
    counters[Counter.GROWTH_ROWS, lane] += 1
    return counters[Counter.GROWTH_ROWS, lane] >= growth_rows.shape[1]


@kernel()
def renormalise(lane: int, slots: np.ndarray, work: np.ndarray) -> float:
    """Bring a lane's tangent back to length 1; the logarithm of the length that it had.

    A tangent that has vanished stays so, with growth -inf; one that has overflowed, or was not a
    number, is not a number from then on.
    """
    length = tangent_length(lane, slots, work)
    if SHORTEST < length < math.inf:
        scale_tangent(1.0 / length, lane, slots, work)
        return math.log(length)
    if length <= SHORTEST:
        scale_tangent(0.0, lane, slots, work)
        return -math.inf
    scale_tangent(math.nan, lane, slots, work)
    return math.nan


@kernel()
def tangent_length(lane: int, slots: np.ndarray, work: np.ndarray) -> float:
    """Length in the metric of the error weights: the scene's own scales for metres and radians."""
    total = 0.0
    for i in range(slots[Slot.STATES]):
        weight = work[(slots[Slot.WEIGHT] + i) * LANES + lane]
        total += abs(work[(slots[Slot.TANGENT] + i) * LANES + lane] * weight)
    if not 0.0 < total < math.inf:
        return total
    square = 0.0  # of shares of the total: the squares themselves might overflow
    for i in range(slots[Slot.STATES]):
        weight = work[(slots[Slot.WEIGHT] + i) * LANES + lane]
        share = work[(slots[Slot.TANGENT] + i) * LANES + lane] * weight / total
        square += share * share
    return total * math.sqrt(square)


@kernel()
def scale_tangent(factor: float, lane: int, slots: np.ndarray, work: np.ndarray) -> None:
    """Multiply a lane's tangent."""
    for i in range(slots[Slot.STATES]):
        work[(slots[Slot.TANGENT] + i) * LANES + lane] *= factor
    for j in range(slots[Slot.JOINTS]):
        work[(slots[Slot.TANGENT_IMPACT_RATE] + j) * LANES + lane] *= factor
