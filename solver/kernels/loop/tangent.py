"""Tangent vectors of lanes: their start, their jump where a contact begins, their growth."""

import math

import numpy as np

from jointplay.solver.kernels.emit.slots import Slots
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.step import Step

GOLDEN = 0.6180339887498949
"""Its multiples less their whole parts are unrelated: a direction that no symmetry singles out."""
SHORTEST = 1e-290
"""Length below which a tangent counts as vanished: its inverse would overflow."""
LN_2 = 0.6931471805599453
ATANH_SERIES = tuple(1.0 / (2 * k + 1) for k in range(11))
"""As in `solver.quantities.elementary`; compiled code takes nothing from outside of this package,
for changes there would not compile it anew."""
LEAST = math.sqrt(0.5)
"""Mantissas are from here to twice as much, about 1."""


def start_tangents(slots: np.ndarray, work: np.ndarray) -> None:
    """Give all lanes a tangent of length 1 that has a share of every coordinate and speed."""
    at = slots[0]
    for lane in range(work.shape[1]):
        for i in range(at.states):
            share = (i + 1) * GOLDEN - math.floor((i + 1) * GOLDEN) + 0.5
            work[at.tangent + i, lane] = share / work[at.weight + i, lane]
        for j in range(at.pairs):
            work[at.tangent_impact_rate + j, lane] = 0.0
        scale_tangent(1.0 / tangent_length(lane, at, work), lane, at, work)


@inner_kernel()
def latch_tangent(j: int, s: Step) -> None:
    """Give the latched impact rate of pair j its derivative along the tangent.

    To be called once `begin_contact` has latched the rate and `tangent_penetrations` was evaluated
    at the same state. A neighbouring run has its onset later by dt = -dδ / δ̇, so it latches
    dδ̇ + δ̈ dt more; a floored rate is the same for all neighbours.

    The tangent of the state itself does not jump (its saltation matrix, Müller 1995, is the
    identity): that matrix is I + (f_after - f_before) ⊗ ∇δ / δ̇, and a contact law whose force
    grows from zero at δ = 0, K δ^n with n >= 1 and friction proportional to it, makes the slope f
    continuous there. The same holds where contact ends. It fails for a law whose force jumps at
    touch, such as a viscous damper without the factor δ^n. Friction with equal limit velocities
    jumps, too, but where the slip reverses, which is no onset; a run with such friction has no
    tangent (`solver.lanes.beginning`).
    """
    lane, at, work = s.lane, s.at, s.work
    rate = work[at.penetration_rate + j, lane]
    latched = 0.0
    if rate > work[at.impact_floor + j, lane]:
        later = -work[at.tangent_penetration + j, lane] / rate
        latched = work[at.tangent_penetration_rate + j, lane]
        latched += work[at.penetration_acceleration + j, lane] * later
    work[at.tangent_impact_rate + j, lane] = latched


@inner_kernel()
def forget_latched(s: Step) -> None:
    """Take from a lane's tangent the derivatives of latched impact rates.

    A rate stays what it is while a contact lasts: a neighbour that has another one never comes
    back, whatever the motion does, and the exponent would be zero. To be called once, before the
    growth that counts: the tangent then begins with another direction. Of contacts that last from
    then on it knows neighbours with the same rates; those that begin later it latches as ever.
    """
    for j in range(s.at.pairs):
        s.work[s.at.tangent_impact_rate + j, s.lane] = 0.0


@inner_kernel()
def record_growth(now: float, s: Step, growths: np.ndarray) -> bool:
    """Hand out by how much a lane's tangent grew since the growth before.

    Returns whether none fits more.

    now : end of that time, s since the start.
    """
    run = s.run
    growth = growths[s.lane, run.growths]
    growth.end = now
    growth.logarithm = renormalise(s.lane, s.at, s.work)
    run.growths += 1
    return run.growths >= growths.shape[1]


@inner_kernel()
def renormalise(lane: int, at: Slots, work: np.ndarray) -> float:
    """Bring a lane's tangent back to length 1. Returns the logarithm of the length that it had.

    A tangent that has vanished stays so, with growth -inf; one that has overflowed is NaN from
    then on.
    """
    length = tangent_length(lane, at, work)
    if SHORTEST < length < math.inf:
        scale_tangent(1.0 / length, lane, at, work)
        return logarithm(length)
    if length <= SHORTEST:
        scale_tangent(0.0, lane, at, work)
        return -math.inf
    scale_tangent(math.nan, lane, at, work)
    return math.nan


@inner_kernel()
def tangent_length(lane: int, at: Slots, work: np.ndarray) -> float:
    """Length in the metric of the error weights: the scene's own scales for metres and radians."""
    total = 0.0
    for i in range(at.states):
        weight = work[at.weight + i, lane]
        total += abs(work[at.tangent + i, lane] * weight)
    if not 0.0 < total < math.inf:
        return total
    square = 0.0  # of shares of the total: the squares themselves might overflow
    for i in range(at.states):
        weight = work[at.weight + i, lane]
        share = work[at.tangent + i, lane] * weight / total
        square += share * share
    return total * math.sqrt(square)


def measure_tangent(slots: np.ndarray, work: np.ndarray, lane: int) -> float:
    """Return the length of a lane's tangent."""
    return float(tangent_length(lane, slots[0], work))


@inner_kernel()
def scale_tangent(factor: float, lane: int, at: Slots, work: np.ndarray) -> None:
    """Multiply a lane's tangent."""
    for i in range(at.states):
        work[at.tangent + i, lane] *= factor
    for j in range(at.pairs):
        work[at.tangent_impact_rate + j, lane] *= factor


@inner_kernel()
def logarithm(x: float) -> float:
    """Return the natural logarithm of a finite x > 0, within 4e-16 of max(1, |log x|).

    That of a C library has other bits on another processor.
    """
    mantissa, exponent = math.frexp(x)
    if mantissa < LEAST:
        mantissa, exponent = 2.0 * mantissa, exponent - 1
    f = (mantissa - 1.0) / (mantissa + 1.0)
    square, series = f * f, 0.0
    for k in range(len(ATANH_SERIES) - 1, -1, -1):
        series = series * square + ATANH_SERIES[k]
    return exponent * LN_2 + 2.0 * f * series
