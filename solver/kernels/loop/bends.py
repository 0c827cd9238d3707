"""Extremes inside steps whose slip comes to where friction bends: each piece between is looked at.

A step may enter a steep ramp of friction and leave it again, as if nothing had happened between its
ends. Slip is smooth on the dense output, whatever friction does: few of its values tell where it
passes a bend. From one such place to the next everything is smooth.
"""

import math

import numpy as np

from jointplay.solver.kernels.emit.places import Places
from jointplay.solver.kernels.jit import LaneFunction, inner_kernel
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import BENDS, INSTANTS
from jointplay.solver.kernels.loop.inner_peaks import place_evenly
from jointplay.solver.kernels.loop.looks_into_steps import look_at_suspects
from jointplay.solver.kernels.loop.runs import Run

BEYOND = 0.5
"""Part of what a cubic goes beyond its ends by which slip may go further than the cubic."""
RATES = 0.02
"""Part of the way at the rates of both ends by which slip may go further, too."""
TURNS = 2
"""Rounds in which places are added to either side of one where a slip turns near a bend."""
MOST_ROUNDS = 12
"""Rounds in which the interval of a passage becomes shorter, mostly by two orders of magnitude."""
SAME = 1e-8
"""Share of a step: places closer than that are one. To one side of a bend friction is flat."""
CLOSE, WIDE = 1e-4, 0.1
"""Places beside the one where a straight line meets a bend, in widths of the interval: as far as
the line errs, which is less in a shorter interval, and to be sure."""
MOST_PLACES = 256
SWAY = 2.0
"""Part of its range that friction may make of a channel in a step with the largest normal force."""


@inner_kernel()
def bends_below(slip: float, j: int, lane: int, at: Places, work: np.ndarray) -> int:
    """Return how many bends of pair j's friction, either way, a slip is above."""
    below = 0
    for k in range(BENDS * j, BENDS * (j + 1)):
        bend = work[at.bend + k, lane]
        below += int(slip > bend) + int(slip > -bend)
    return below


@inner_kernel()
def nearest_bend(slip: float, j: int, lane: int, at: Places, work: np.ndarray) -> float:
    """Return the distance of a slip from the nearest bend of pair j's friction, m/s."""
    nearest = np.inf
    for k in range(BENDS * j, BENDS * (j + 1)):
        nearest = min(nearest, abs(abs(slip) - work[at.bend + k, lane]))
    return nearest


@inner_kernel()
def bends(j: int, lane: int, at: Places, work: np.ndarray) -> bool:
    """Whether pair j touches with friction that bends somewhere."""
    return bool(work[at.mode + j, lane] > 0.0 and work[at.bend + BENDS * j, lane] < np.inf)


@inner_kernel()
def beyond_ends(change: float, begin: float, end: float) -> tuple[float, float]:
    """Return how far a cubic goes below and above both of its ends, from 0 to `change`.

    begin, end
        Its slopes there, as changes over the whole step.
    """
    curving, bending = 6.0 * change - 4.0 * begin - 2.0 * end, 3.0 * (begin + end) - 6.0 * change
    below, above = min(0.0, change), max(0.0, change)
    least, most = below, above
    root = curving * curving - 4.0 * bending * begin  # of the cubic's slope, a parabola
    if root >= 0.0:
        q = -0.5 * (curving + math.copysign(math.sqrt(root), curving))
        for above_line, below_line in ((q, bending), (begin, q)):
            if 0.0 < above_line * below_line < below_line * below_line:
                share = above_line / below_line
                value = share * (begin + share * (0.5 * curving + share * bending / 3.0))
                least, most = min(least, value), max(most, value)
    return below - least, most - above


@inner_kernel()
def may_pass_bend(lane: int, at: Places, work: np.ndarray) -> bool:
    """Whether a slip may pass a bend and come back in this step, or pass more than one.

    Both is told by its values and rates at both ends: one bend that is passed once shows there.
    """
    step = work[at.tried, lane]
    for j in range(at.pairs):
        if bends(j, lane, at, work):
            before, now = work[at.slip_start + j, lane], work[at.slip + j, lane]
            begin, end = (
                step * work[at.slip_rate_start + j, lane],
                step * work[at.slip_rate + j, lane],
            )
            below, above = beyond_ends(now - before, begin, end)
            margin = RATES * (abs(begin) + abs(end))
            low, high = min(before, now), max(before, now)
            least = low - (1.0 + BEYOND) * below - margin
            most = high + (1.0 + BEYOND) * above + margin
            first, last = bends_below(low, j, lane, at, work), bends_below(high, j, lane, at, work)
            if (
                last - first > 1
                or bends_below(least, j, lane, at, work) < first
                or bends_below(most, j, lane, at, work) > last
            ):
                return True
    return False


@inner_kernel()
def find_in_reach(lane: int, at: Places, work: np.ndarray, found: np.ndarray) -> int:
    """Write the rows that friction may bring to a record in this step; how many.

    It is as large as the normal force allows, and so it was where that was largest.
    """
    share, count = 0.0, 0
    for j in range(at.pairs):
        if bends(j, lane, at, work):
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
def any_bend(at: Places, work: np.ndarray) -> bool:
    """Whether a slip in any lane may come to a bend in the step that it takes."""
    for lane in range(LANES):
        if work[at.accept, lane] > 0.0 and may_pass_bend(lane, at, work):
            return True
    return False


@inner_kernel()
def look_between_bends(
    chosen: np.ndarray,
    low: float,
    high: float,
    lane: int,
    run: Run,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    table: np.ndarray,
    channels_around: LaneFunction,
    channels_within: LaneFunction,
    gaps_within: LaneFunction,
) -> None:
    """Seek extremes of chosen rows between two shares, from one passage of a bend to the next."""
    if len(chosen) == 0:
        return
    cuts, begin = np.empty((MOST_PLACES + 1, 2)), low
    count = find_cuts(low, high, lane, at, work, spare, gaps_within, cuts)
    cuts[count] = high
    for end, behind in cuts[: count + 1]:
        if begin < end:
            place_evenly(begin, end, at, spare)
            channels_within(work, spare, lane)
            look_at_suspects(chosen, begin, end, lane, run, at, work, spare, table, channels_around)
        begin = max(begin, behind)


@inner_kernel()
def find_cuts(
    low: float,
    high: float,
    lane: int,
    at: Places,
    work: np.ndarray,
    spare: np.ndarray,
    gaps_within: LaneFunction,
    cuts: np.ndarray,
) -> int:
    """Find where slips pass bends between two shares of a step, in the order of time.

    cuts : (MOST_PLACES, 2)
        Where the shares just before and just behind each bend are written; how many is returned.
    """
    shares, slips, wanted = np.empty(MOST_PLACES), np.empty(MOST_PLACES), np.empty(MOST_PLACES)
    found = 0
    for j in range(at.pairs):
        if not bends(j, lane, at, work):
            continue
        for i in range(INSTANTS):
            wanted[i] = low + (high - low) * (i / (INSTANTS - 1))
        count, more = 0, INSTANTS
        for turn in range(MOST_ROUNDS):
            for first in range(0, more, INSTANTS):
                for i in range(INSTANTS):
                    spare[at.theta, i] = wanted[min(first + i, more - 1)]
                gaps_within(work, spare, lane)
                for i in range(min(INSTANTS, more - first)):
                    count = insert(wanted[first + i], spare[at.slip + j, i], shares, slips, count)
            more = want_more(turn < TURNS, shares, slips, count, j, lane, at, work, wanted)
            if more == 0 or count + more > MOST_PLACES:
                break
        for i in range(1, count):
            below = bends_below(slips[i - 1], j, lane, at, work)
            if below != bends_below(slips[i], j, lane, at, work) and found < MOST_PLACES:
                insert(shares[i - 1], shares[i], cuts[:, 0], cuts[:, 1], found)
                found += 1
    return found


@inner_kernel()
def insert(share: float, value: float, shares: np.ndarray, values: np.ndarray, count: int) -> int:
    """Put a share of the step and a value among ascending ones; how many there are now."""
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
    lane: int,
    at: Places,
    work: np.ndarray,
    wanted: np.ndarray,
) -> int:
    """Write places next to those where a slip passes a bend, or turns near one; how many."""
    more = 0
    for i in range(count):
        left, right = max(i - 1, 0), min(i + 1, count - 1)
        width = shares[right] - shares[i]
        below = bends_below(slips[i], j, lane, at, work)
        behind = bends_below(slips[right], j, lane, at, work)
        if below != behind:
            for k in range(BENDS * j, BENDS * (j + 1)):
                for sense in (1.0, -1.0):
                    bend = sense * work[at.bend + k, lane]
                    between = (bend - slips[i]) * (bend - slips[right]) <= 0.0
                    if between and width > SAME and more + 4 <= MOST_PLACES:
                        share = (bend - slips[i]) / (slips[right] - slips[i])
                        near = min(max(CLOSE, 0.5 * width), 0.5 * WIDE)
                        for beside in (-WIDE, -near, near, WIDE):
                            inside = min(max(share + beside, CLOSE), 1.0 - CLOSE)
                            wanted[more] = shares[i] + inside * width
                            more += 1
        rise, fall = slips[i] - slips[left], slips[i] - slips[right]
        reached = nearest_bend(slips[i], j, lane, at, work) < abs(rise) + abs(fall)
        same = bends_below(slips[left], j, lane, at, work) == below == behind
        if turning and rise * fall >= 0.0 and reached and same and more + 6 <= MOST_PLACES:
            for k in range(1, 4):
                wanted[more] = shares[left] + 0.25 * k * (shares[i] - shares[left])
                wanted[more + 1] = shares[i] + 0.25 * k * width
                more += 2
    return more
