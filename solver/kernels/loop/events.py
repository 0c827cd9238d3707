"""Poincare sections at events: the onset of a contact, or a channel that crosses a value.

An angle crosses a value once a turn: its levels are a whole turn apart. Whether a channel may cross
within a step is judged by its changes in this step and the one before. Where it may, it is looked
at eight instants and about each passage of a journal by the centre of its bearing, and more
closely where it turns near a level.
"""

import math

import numpy as np

from jointplay.solver.kernels.emit.judging import PASSING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.dense_rows import write_row
from jointplay.solver.kernels.loop.extremes.passages import (
    PARTS,
    beside,
    closest_approach,
    next_passage,
    path_of,
)
from jointplay.solver.kernels.loop.extremes.search.local_extremes import place_evenly
from jointplay.solver.kernels.loop.runs import SECTIONS, Run, SectionKind
from jointplay.solver.kernels.loop.step import Step, channels_within

LEVELS = 14
"""Each narrows the interval of a crossing to an eighth: 2e-13 of the step at the end."""
REACH = 2.0
"""Changes of a channel in this step and the last one, by which it may be away in between."""
ROUNDS = 4
"""Each adds three instants to either side of one where a channel turns near a level."""
MOST_INSTANTS = 128
MOST_IN_A_STEP = 64
"""Sections in a step: as much room is left in a buffer."""
SAME = 1e-12
"""Share of a step: instants closer than that are one."""


@inner_kernel()
def any_crossing(runs: np.ndarray) -> bool:
    """Whether a lane takes its sections where a channel crosses a value."""
    found = False
    for lane in range(len(runs)):
        found |= runs[lane].section_kind == SectionKind.CROSSING
    return found


@inner_kernel()
def has_all_events(run: Run) -> bool:
    """Whether a lane with sections at events has as many as it shall have."""
    return run.section_kind != SectionKind.CRANK and run.next[SECTIONS] >= run.stop[SECTIONS]


@inner_kernel()
def record_event(i: int, s: Step, source: np.ndarray, rows: np.ndarray) -> bool:
    """Write the state in column i of `source` as a section.

    Returns whether the buffer is full now.
    """
    lane, run, at, work = s.lane, s.run, s.at, s.work
    begun = float(run.periods) * run.period
    if begun + source[at.stage_time, i] < run.section_from or has_all_events(run):
        return False
    write_row(rows[SECTIONS, lane, run.filled[SECTIONS]], i, lane, run, at, work, source)
    run.filled[SECTIONS] += 1
    run.next[SECTIONS] += 1
    return run.filled[SECTIONS] >= rows.shape[2] - MOST_IN_A_STEP


@inner_kernel()
def height(value: float, run: Run) -> float:
    """Return how far a channel's value is beyond a section's, in the sense that counts."""
    return float(run.section_sense * (value - run.section_value))


@inner_kernel()
def level(height: float, run: Run) -> float:
    """Return the number of levels at or below a height: a section is taken where it grows."""
    if run.section_turn > 0.0:
        return math.floor(height / run.section_turn)
    return 0.0 if height >= 0.0 else -1.0


@inner_kernel()
def beside_levels(height: float, run: Run) -> tuple[float, float]:
    """Return how far the levels at or below and above a height are; infinite where none is."""
    turn = run.section_turn
    if turn > 0.0:
        whole = math.floor(height / turn)
        return height - turn * whole, turn * (whole + 1.0) - height
    return (height, math.inf) if height >= 0.0 else (math.inf, -height)


@inner_kernel()
def may_cross(s: Step) -> bool:
    """Whether a lane's channel may come to a level of its section within the step.

    A channel that time alone gives is not followed from step to step: it may always.
    """
    lane, run, at, work = s.lane, s.run, s.at, s.work
    if run.section_kind != SectionKind.CROSSING:
        return False
    index = run.section_index
    if index >= at.rows or int(work[at.flag, lane]) & PASSING:
        return True
    before = height(work[at.previous + index, lane], run)
    now = height(work[at.channel + index, lane], run)
    if level(before, run) != level(now, run):
        return True
    reach = REACH * (abs(now - before) + abs(work[at.change + index, lane]))
    nearest = min(min(beside_levels(before, run)), min(beside_levels(now, run)))
    return not nearest > reach  # before the first step there is no change: it is NaN


@inner_kernel()
def record_crossings(s: Step, rows: np.ndarray) -> bool:
    """Write a section for each crossing inside the step. Returns whether the buffer is full now."""
    run = s.run
    shares, heights = np.empty(MOST_INSTANTS), np.empty(MOST_INSTANTS)
    count = instants_to_look_at(s, shares)
    look_at(shares, count, heights, s)
    for _ in range(ROUNDS):
        more = refined(shares, heights, count, run)
        if more == count:
            break
        count = more
        look_at(shares, count, heights, s)
    full = False
    taken = 0
    for i in range(1, count):
        wanted = level(heights[i], run)
        if wanted > level(heights[i - 1], run) and taken < MOST_IN_A_STEP:
            found = locate(wanted, shares[i - 1], shares[i], s)
            full |= record_event(found, s, s.spare, rows)
            taken += 1
    return full


@inner_kernel()
def instants_to_look_at(s: Step, shares: np.ndarray) -> int:
    """Set the shares of the step at which to look first, in their order.

    Returns how many there are.
    """
    place_evenly(0.0, 1.0, shares)
    count = INSTANTS
    for j in range(s.at.pairs):
        path = path_of(j, s)
        part = next_passage(j, 0, path, s)
        while part < PARTS and count + INSTANTS <= MOST_INSTANTS // 4:
            passage = closest_approach(path, part, s)
            for i in range(INSTANTS):
                shares[count + i] = beside(i, passage)
            count += INSTANTS
            part = next_passage(j, part + 1, path, s)
    return ordered(shares, count)


@inner_kernel()
def ordered(shares: np.ndarray, count: int) -> int:
    """Sort shares and leave out those that are there already. Returns how many are left."""
    for i in range(1, count):  # they are in order but for some
        share, place = shares[i], i
        while place > 0 and shares[place - 1] > share:
            shares[place] = shares[place - 1]
            place -= 1
        shares[place] = share
    kept = 1
    for i in range(1, count):
        if shares[i] - shares[kept - 1] > SAME:
            shares[kept] = shares[i]
            kept += 1
    shares[kept - 1] = 1.0
    return kept


@inner_kernel()
def look_at(shares: np.ndarray, count: int, heights: np.ndarray, s: Step) -> None:
    """Evaluate a section's channel at shares of the step; its ends are those of other steps."""
    lane, run, at, work = s.lane, s.run, s.at, s.work
    index = run.section_index
    for first in range(0, count, INSTANTS):
        many = min(INSTANTS, count - first)
        for i in range(INSTANTS):
            s.spare[at.theta, i] = shares[first + min(i, many - 1)]
        channels_within(s)
        for i in range(many):
            heights[first + i] = height(s.spare[at.channel + index, i], run)
    if index < at.rows:
        heights[0] = height(work[at.previous + index, lane], run)
        heights[count - 1] = height(work[at.channel + index, lane], run)


@inner_kernel()
def refined(shares: np.ndarray, heights: np.ndarray, count: int, run: Run) -> int:
    """Add instants next to those where a channel may turn at a level.

    Returns how many there are now.
    """
    total = count
    for i in range(count):
        left, right = max(i - 1, 0), min(i + 1, count - 1)
        rise, fall = heights[i] - heights[left], heights[i] - heights[right]
        near, (below, above) = abs(rise) + abs(fall), beside_levels(heights[i], run)
        top = rise >= 0.0 and fall >= 0.0 and above < near
        bottom = rise <= 0.0 and fall <= 0.0 and below < near
        same = level(heights[left], run) == level(heights[i], run) == level(heights[right], run)
        if (top or bottom) and same and total + 6 <= MOST_INSTANTS:
            for k in range(1, 4):
                shares[total] = shares[left] + 0.25 * k * (shares[i] - shares[left])
                shares[total + 1] = shares[i] + 0.25 * k * (shares[right] - shares[i])
                total += 2
    return ordered(shares, total) if total > count else count


@inner_kernel()
def locate(wanted: float, low: float, high: float, s: Step) -> int:
    """Return the column of `spare` that holds the state where a channel comes to a level.

    wanted : the number of that level, at which the channel is at the share `high` of the step.
    """
    run = s.run
    found = INSTANTS - 1
    for _ in range(LEVELS):
        width = (high - low) / INSTANTS
        for i in range(INSTANTS):
            s.spare[s.at.theta, i] = low + width * (i + 1)
        channels_within(s)
        found = INSTANTS - 1
        for i in range(INSTANTS):
            if level(height(s.spare[s.at.channel + run.section_index, i], run), run) >= wanted:
                found = i
                break
        low, high = low + width * found, low + width * (found + 1)
    return found
