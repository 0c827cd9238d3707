"""Dormand and Prince's method of order 8, stepping onto onsets, releases, kinks and instants.

Coefficients are those that SciPy's `DOP853` carries (Hairer, Norsett, Wanner 1993, section II.10).
In free flight the local error may be zero, so geometry bounds the step: no body turns and no
journal crosses more than a share of its bearing.
"""

import math

import numpy as np
from scipy.integrate import DOP853

from benchmarks.lies.truth.compiled import compiled, compiled_inside
from benchmarks.lies.truth.contacts import DAMPING, GAP, GAP_RATE, SEEN, TOLD, VX, VY
from benchmarks.lies.truth.equations import accelerate, project
from benchmarks.lies.truth.mechanism import Floats, Mechanism

STAGES = 12
A = np.ascontiguousarray(DOP853.A)
B = np.ascontiguousarray(DOP853.B)
C = np.ascontiguousarray(DOP853.C)
E3, E5 = np.ascontiguousarray(DOP853.E3), np.ascontiguousarray(DOP853.E5)

TURN = 0.25
"""Largest turn of a body in a step, rad."""
CROSSING = 0.2
"""Largest way of a journal that flies, in radial clearances."""
LANDED = 4e-15
"""Gap, in metres per metre of the mechanism, at which a contact begins or ends."""
NEAR = 0.02
"""Share of a step at whose ends a kink may lie: the rest is left to the error control."""
FIRST = 1e-3
"""The first step in contact closes this share of the clearance."""
DONE, TOO_LONG, SINGULAR = range(3)


@compiled_inside
def attempt(
    m: Mechanism,
    t: float,
    h: float,
    y: Floats,
    closed: np.ndarray,
    impact: Floats,
    k: Floats,
    told: Floats,
    multipliers: Floats,
    added: Floats,
    new: Floats,
    scale: Floats,
) -> float:
    """Fill in what a step adds, and the state a step later.

    Returns the error, by what it may be: that of Hairer's pair of estimates, 5 and 3.
    """
    count = len(y)
    for s in range(1, STAGES):
        for i in range(count):
            total = 0.0
            for r in range(s):
                total += A[s, r] * k[r, i]
            new[i] = y[i] + h * total
        if not accelerate(m, t + C[s] * h, new, closed, impact, k[s], told, multipliers):
            return math.inf
    for i in range(count):
        total = 0.0
        for r in range(STAGES):
            total += B[r] * k[r, i]
        added[i] = h * total
        new[i] = y[i] + added[i]
    if not accelerate(m, t + h, new, closed, impact, k[STAGES], told, multipliers):
        return math.inf
    fine, coarse = 0.0, 0.0
    for i in range(count):
        third, fifth = 0.0, 0.0
        for r in range(STAGES + 1):
            third += E3[r] * k[r, i]
            fifth += E5[r] * k[r, i]
        fine = max(fine, (fifth / scale[i]) ** 2)
        coarse = max(coarse, (third / scale[i]) ** 2)
    if fine == 0.0 and coarse == 0.0:
        return 0.0
    error: float = abs(h) * fine / math.sqrt(fine + 0.01 * coarse)
    return error


@compiled_inside
def root(left: float, right: float, slope_left: float, slope_right: float) -> float:
    """Return the share of a step at which Hermite's cubic changes sign, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        at = 0.5 * (low + high)
        if (cubic(at, left, right, slope_left, slope_right) > 0.0) == (right > 0.0):
            high = at
        else:
            low = at
    return 0.5 * (low + high)


@compiled_inside
def cubic(at: float, left: float, right: float, slope_left: float, slope_right: float) -> float:
    """Return Hermite's cubic at a share of a step; slopes are those over the whole step."""
    rest = 1.0 - at
    value: float = left * (1.0 + 2.0 * at) * rest * rest + right * (3.0 - 2.0 * at) * at * at
    value += at * rest * (slope_left * rest - slope_right * at)
    return value


@compiled_inside
def turning(left: float, right: float, slope_left: float, slope_right: float) -> float:
    """Return the share of a step at which the slope of Hermite's cubic changes sign."""
    low, high = 0.0, 1.0
    for _ in range(40):
        at = 0.5 * (low + high)
        rest = 1.0 - at
        slope = 6.0 * at * rest * (right - left)
        slope += slope_left * rest * (1.0 - 3.0 * at) - slope_right * at * (2.0 - 3.0 * at)
        if (slope > 0.0) == (slope_left > 0.0):
            low = at
        else:
            high = at
    return 0.5 * (low + high)


@compiled_inside
def kink(m: Mechanism, j: int, which: int, told: Floats) -> float:
    """Return what changes sign where the force of a contact has a kink."""
    if which == 0:
        return told[DAMPING] if m.law[j, 4] > 0.0 else 1.0
    if m.law[j, 6] == 0.0:
        return 1.0
    edge = m.law[j, 7] if which < 3 else m.law[j, 8]
    value: float = told[SEEN] + (edge if which % 2 == 0 else -edge)
    return value if edge > 0.0 else 1.0


@compiled_inside
def shorter(
    m: Mechanism, h: float, closed: np.ndarray, before: Floats, after: Floats, landed: float
) -> float:
    """Return the share of a step at which the first event inside it lies; 1: none does."""
    share = 1.0
    for j in range(len(closed)):
        left, right = before[j, GAP], after[j, GAP]
        slope_left, slope_right = h * before[j, GAP_RATE], h * after[j, GAP_RATE]
        sign = -1.0 if closed[j] else 1.0  # the event is a rise through zero of this times the gap
        if sign * right > landed and sign * left <= landed:
            found = root(left, right, slope_left, slope_right)
            share = min(share, min(max(found, 1e-9), 1.0 - 1e-12))
        elif sign * slope_left > 0.0 > sign * slope_right:
            at = turning(left, right, slope_left, slope_right)
            reach = abs(left) + abs(right)
            peak = cubic(at, left, right, slope_left, slope_right)
            if sign * peak > -0.1 * reach and NEAR < at < 1.0 - NEAR:
                share = min(share, at)
        if not closed[j]:
            continue
        for which in range(5):
            one, two = kink(m, j, which, before[j]), kink(m, j, which, after[j])
            if (one > 0.0) != (two > 0.0):
                at = one / (one - two)
                if NEAR < at < 1.0 - NEAR:
                    share = min(share, at)
    return share


@compiled_inside
def longest(
    m: Mechanism, y: Floats, closed: np.ndarray, told: Floats, share: float, most: float
) -> float:
    """Return the longest step that turns no body and moves no journal by too much."""
    half = len(y) // 2
    step = most
    for b in range(half // 3):
        spin = abs(y[half + 3 * b + 2])
        if spin * step > TURN * share:
            step = TURN * share / spin
    for j in range(len(closed)):
        way = CROSSING * share * m.law[j, 0]
        speed = math.hypot(told[j, VX], told[j, VY])
        if not closed[j] and speed * step > way:
            step = way / speed
    return step


@compiled_inside
def keep(values: Floats, row: Floats) -> None:
    """Copy values to a row; compiling an assigned array takes seconds, for a check of shapes."""
    for i in range(len(values)):
        row[i] = values[i]


@compiled_inside
def note(began: Floats, onsets: int, j: int, t: float) -> int:
    """Write down an onset; how many there are now."""
    if onsets < len(began):
        began[onsets, 0], began[onsets, 1] = j, t
    return onsets + 1


@compiled
def integrate(
    m: Mechanism,
    start: Floats,
    instants: Floats,
    scale: Floats,
    share: float,
    most_attempts: int,
    states: Floats,
    tolds: Floats,
    forces: Floats,
    began: Floats,
) -> int:
    """Fill in state, slopes, contacts and multipliers at each instant; return how it ended.

    Parameters
    ----------
    scale : (states,) errors that a step may make
    share : of the longest steps that geometry allows
    states, tolds, forces : (instants, 2 states), (instants, joints, TOLD), (instants, rows)
    began : (most, 2) joint and time of each onset, as many as there is room for
    """
    count, joints, rows, onsets = len(start), len(m.play), len(m.row), 0
    y, new = start.copy(), np.empty(count)
    added, k = np.empty(count), np.empty((STAGES + 1, count))
    before, after = np.zeros((joints, TOLD)), np.zeros((joints, TOLD))
    multipliers = np.empty(rows)
    closed, impact = np.zeros(joints, np.bool_), np.ones(joints)
    size = 0.0  # by loops: to compile `max` of an array takes a second
    for i in range(count // 2):
        size = max(size, abs(start[i]))
    for j in range(joints):
        size = max(size, m.law[j, 0])
    landed = LANDED * size
    project(m, 0.0, y)
    if not accelerate(m, 0.0, y, closed, impact, k[0], before, multipliers):
        return SINGULAR
    for j in range(joints):
        impact[j] = max(before[j, GAP_RATE], m.law[j, 10])
        closed[j] = before[j, GAP] > landed
        if closed[j]:
            onsets = note(began, onsets, j, 0.0)
    accelerate(m, 0.0, y, closed, impact, k[0], before, multipliers)
    t, natural = 0.0, 1e-6 * instants[-1]
    wanted, attempts = 0, 0
    lost = np.zeros(count)
    while True:
        while wanted < len(instants) and t >= instants[wanted]:
            keep(y, states[wanted, :count])
            keep(k[0], states[wanted, count:])
            for j in range(joints):
                keep(before[j], tolds[wanted, j])
            keep(multipliers, forces[wanted])
            wanted += 1
        if wanted == len(instants):
            return DONE
        left = instants[wanted] - t
        h = min(natural, longest(m, y, closed, before, share, left))
        bounded = h < natural
        while True:
            attempts += 1
            if attempts > most_attempts:
                return TOO_LONG
            error = attempt(m, t, h, y, closed, impact, k, after, multipliers, added, new, scale)
            if not error <= 1.0:
                h *= max(0.2, 0.9 * error ** (-1.0 / 8.0)) if error < 1e30 else 0.2
                natural, bounded = h, False
                if not h > 1e-18:
                    return SINGULAR
                continue
            part = shorter(m, h, closed, before, after, landed)
            if part == 1.0:
                break
            h *= part
            bounded = True
        for i in range(count):  # summed with what rounding lost before (Kahan 1965)
            whole = added[i] + lost[i]
            total = y[i] + whole
            lost[i] = whole - (total - y[i])
            y[i] = total
        t = instants[wanted] if h >= left else t + h
        project(m, t, y)
        accelerate(m, t, y, closed, impact, k[0], before, multipliers)
        growth = 5.0
        if error > 0.0:
            growth = min(5.0, 0.9 * error ** (-1.0 / 8.0))
        natural = max(natural, growth * h) if bounded else growth * h
        switched = False
        for j in range(joints):
            gap, rate = before[j, GAP], before[j, GAP_RATE]
            if not closed[j] and gap > -landed and rate > 0.0:
                closed[j], impact[j] = True, max(rate, m.law[j, 5])
                natural = min(natural, FIRST * m.law[j, 0] / impact[j])
                onsets = note(began, onsets, j, t)
                switched = True
            elif closed[j] and gap < landed and rate < 0.0:
                closed[j] = False
                switched = True
        if switched:
            accelerate(m, t, y, closed, impact, k[0], before, multipliers)
