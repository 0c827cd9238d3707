"""Extremes inside steps whose slip comes to where friction bends: each piece between is looked at.

A step may enter a steep ramp of friction and leave it again, as if nothing had happened between its
ends; `solver.kernels.emit.bends` says which may. From one passage of a bend to the next everything
is smooth. Slip is smooth on the dense output, whatever friction does: few of its values tell where
it passes a bend, and the intervals of these passages shrink to nothing.
"""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import BENDS, INSTANTS
from jointplay.solver.kernels.loop.extremes.search.local_extremes import look_evenly, place_evenly
from jointplay.solver.kernels.loop.step import Step, penetrations_within

SWAY = 2.0
"""Part of its range that friction may make of a channel in a step with the largest normal force."""
TURNS = 2
"""Rounds in which instants are added to either side of one where a slip turns near a bend."""
MOST_ROUNDS = 12
"""Rounds in which the interval of a passage becomes shorter, mostly by two orders of magnitude."""
SAME = 1e-8
"""Share of a step: instants closer than that are one. To one side of a bend friction is flat."""
CLOSE, WIDE = 1e-4, 0.1
"""Instants beside the one where a straight line meets a bend, in widths of the interval: as far as
the line errs, which is less in a shorter interval, and to be sure."""
MOST_INSTANTS = 256


@inner_kernel()
def find_in_reach(s: Step, found: np.ndarray) -> int:
    """Write the rows that friction may bring to a new extreme in this step. Returns how many.

    It is as large as the normal force allows, and so it was where that was largest.
    """
    lane, at, work = s.lane, s.at, s.work
    share, count = 0.0, 0
    for j in range(at.pairs):
        if has_bend(j, s):
            row = int(work[at.normal_row + j, lane])
            normal = max(work[at.previous + row, lane], work[at.channel + row, lane])
            share = max(share, normal / work[at.highest + row, lane])
    for r in range(at.rows):
        before, now = work[at.previous + r, lane], work[at.channel + r, lane]
        lowest, highest = work[at.lowest + r, lane], work[at.highest + r, lane]
        reach = SWAY * share * (highest - lowest)
        if not (max(before, now) + reach < highest and min(before, now) - reach > lowest):
            found[count] = r
            count += 1
    return count


@inner_kernel()
def look_between_bends(chosen: np.ndarray, low: float, high: float, s: Step) -> None:
    """Seek extremes of chosen rows between two shares, from one passage of a bend to the next.

    Rows that depend on no friction have no kinks there, and are not looked at.
    """
    bent, rows = 0, np.empty(len(chosen), np.int64)
    for r in chosen:
        if s.work[s.at.bent + r, s.lane] > 0.0:
            rows[bent] = r
            bent += 1
    if bent == 0:
        return
    cuts, begin = np.empty((MOST_INSTANTS + 1, 2)), low
    count = find_cuts(low, high, s, cuts)
    cuts[count] = high
    for end, behind in cuts[: count + 1]:
        if begin < end:
            look_evenly(rows[:bent], begin, end, s)
        begin = max(begin, behind)


@inner_kernel(borrows=True)
def bends_below(slip: float, j: int, s: Step) -> int:
    """Return how many bends of pair j's friction, either way, a slip is above."""
    below = 0
    for k in range(BENDS * j, BENDS * (j + 1)):
        bend = s.work[s.at.bend + k, s.lane]
        below += int(slip > bend) + int(slip > -bend)
    return below


@inner_kernel()
def nearest_bend(slip: float, j: int, s: Step) -> float:
    """Return the distance of a slip from the nearest bend of pair j's friction, m/s."""
    nearest = np.inf
    for k in range(BENDS * j, BENDS * (j + 1)):
        nearest = min(nearest, abs(abs(slip) - s.work[s.at.bend + k, s.lane]))
    return nearest


@inner_kernel(borrows=True)
def has_bend(j: int, s: Step) -> bool:
    """Whether pair j touches with friction that bends somewhere."""
    lane, at, work = s.lane, s.at, s.work
    return bool(work[at.mode + j, lane] > 0.0 and work[at.bend + BENDS * j, lane] < np.inf)


@inner_kernel()
def find_cuts(low: float, high: float, s: Step, cuts: np.ndarray) -> int:
    """Find where slips pass bends between two shares of a step, in the order of time.

    cuts : (MOST_INSTANTS, 2)
        Where the shares just before and just behind each bend are written. Returns how many.
    """
    shares, slips = np.empty(MOST_INSTANTS), np.empty(MOST_INSTANTS)
    wanted = np.empty(MOST_INSTANTS)
    found = 0
    for j in range(s.at.pairs):
        if not has_bend(j, s):
            continue
        place_evenly(low, high, wanted)
        count, more = 0, INSTANTS
        for turn in range(MOST_ROUNDS):
            for first in range(0, more, INSTANTS):
                for i in range(INSTANTS):
                    s.spare[s.at.theta, i] = wanted[min(first + i, more - 1)]
                penetrations_within(s)
                for i in range(min(INSTANTS, more - first)):
                    count = insert(
                        wanted[first + i], s.spare[s.at.slip + j, i], shares, slips, count
                    )
            more = want_more(turn < TURNS, shares, slips, count, j, s, wanted)
            if more == 0 or count + more > MOST_INSTANTS:
                break
        for i in range(1, count):
            below = bends_below(slips[i - 1], j, s)
            if below != bends_below(slips[i], j, s) and found < MOST_INSTANTS:
                insert(shares[i - 1], shares[i], cuts[:, 0], cuts[:, 1], found)
                found += 1
    return found


@inner_kernel()
def insert(share: float, value: float, shares: np.ndarray, values: np.ndarray, count: int) -> int:
    """Put a share of the step and a value among ascending ones. Returns how many there are now."""
    i = count
    while i > 0 and shares[i - 1] > share:
        shares[i], values[i] = shares[i - 1], values[i - 1]
        i -= 1
    shares[i], values[i] = share, value
    return count + 1


@inner_kernel()
def want_more(
    turning: bool,
    shares: np.ndarray,
    slips: np.ndarray,
    count: int,
    j: int,
    s: Step,
    wanted: np.ndarray,
) -> int:
    """Write instants next to those where a slip passes a bend, or turns near one.

    Returns how many.
    """
    more = 0
    for i in range(count):
        left, right = max(i - 1, 0), min(i + 1, count - 1)
        width = shares[right] - shares[i]
        below = bends_below(slips[i], j, s)
        behind = bends_below(slips[right], j, s)
        if below != behind:
            for k in range(BENDS * j, BENDS * (j + 1)):
                for sense in (1.0, -1.0):
                    bend = sense * s.work[s.at.bend + k, s.lane]
                    between = (bend - slips[i]) * (bend - slips[right]) <= 0.0
                    if between and width > SAME and more + 4 <= MOST_INSTANTS:
                        share = (bend - slips[i]) / (slips[right] - slips[i])
                        near = min(max(CLOSE, 0.5 * width), 0.5 * WIDE)
                        for beside in (-WIDE, -near, near, WIDE):
                            inside = min(max(share + beside, CLOSE), 1.0 - CLOSE)
                            wanted[more] = shares[i] + inside * width
                            more += 1
        rise, fall = slips[i] - slips[left], slips[i] - slips[right]
        reached = nearest_bend(slips[i], j, s) < abs(rise) + abs(fall)
        same = bends_below(slips[left], j, s) == below == behind
        if turning and rise * fall >= 0.0 and reached and same and more + 6 <= MOST_INSTANTS:
            for k in range(1, 4):
                wanted[more] = shares[left] + 0.25 * k * (shares[i] - shares[left])
                wanted[more + 1] = shares[i] + 0.25 * k * width
                more += 2
    return more
