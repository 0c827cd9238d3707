"""Extremes inside steps that no scan of step ends finds.

Where a run begins or ends there is no step beside that would tell that a channel turned; where a
journal passes the centre of its bearing its normal whips round; in long steps of a contact, which a
method of high order or of fixed steps takes, anything may happen; and steps at the limit of
stability swing inside.
"""

import numpy as np

from jointplay.solver.kernels.emit.judging import SWINGING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.brackets import CLOSER
from jointplay.solver.kernels.loop.passages import (
    NARROWEST,
    closest_approach,
    distance_and_speed,
    orbiting_at_end,
    passes,
)
from jointplay.solver.kernels.loop.peaks import look_at_extremes
from jointplay.solver.kernels.loop.roughness import is_due, may_set_extremes
from jointplay.solver.kernels.loop.runs import NO_PAIR
from jointplay.solver.kernels.loop.step import Step, channels_within
from jointplay.solver.kernels.loop.tops import open_brackets
from jointplay.solver.kernels.loop.turns_before_onset import turns_before_onset
from jointplay.solver.kernels.trace.rows import NO_ROW

EXACT = 0.0
"""Share of its range by which what is counted may be off: a quartic through such instants may pass
where a contact ends.  Extremes are evaluated where it turns."""
SLACK = 0.1
"""Share of a journal's speed by which the slip at a passage may exceed what is expected."""
WIDTHS = 2.0
"""Widths of a passage to either side in which extremes are sought."""


@inner_kernel()
def look_at_passages(s: Step) -> None:
    """Seek extremes where a journal passes the centre of its bearing.

    To be called while ``channel`` has the values at the step's end, before the scan.
    """
    lane, at, work = s.lane, s.at, s.work
    for j in range(at.pairs):
        if not passes(j, s):
            continue
        share, width = closest_approach(j, s)
        if NARROWEST < share < 1.0 - NARROWEST and may_be_fastest(j, share, width, s):
            low, high = max(share - WIDTHS * width, 0.0), min(share + WIDTHS * width, 1.0)
            place_evenly(low, high, s)
            channels_within(s)
            waiting = 0
            for row in (int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])):
                if row != NO_ROW:
                    waiting = look_at_instants(row, waiting, low, high, s)
            look_at_extremes(waiting, s)


@inner_kernel()
def may_be_fastest(j: int, share: float, width: float, s: Step) -> bool:
    """Whether a pair's slip or penetration may have a new extreme where it passes the centre.

    There the slip is that of the spins, as at the end of the step, and all of the journal's speed.
    """
    lane, at, work = s.lane, s.at, s.work
    distance, speed = distance_and_speed(j, share, s)
    slip, depth = int(work[at.slip_row + j, lane]), int(work[at.penetration_row + j, lane])
    found = depth != NO_ROW and distance - work[at.inner + j, lane] < work[at.lowest + depth, lane]
    if slip != NO_ROW:
        spinning = work[at.channel + slip, lane] - orbiting_at_end(j, s)
        beyond = SLACK * speed
        found |= spinning + speed + beyond > work[at.highest + slip, lane]
        found |= spinning - speed - beyond < work[at.lowest + slip, lane]
    return bool(found)


@inner_kernel()
def look_inside(s: Step) -> None:
    """Seek extremes of all channels in a step that begins or ends the run, swings or is rough.

    Also in one that ends at an onset, where a channel may turn unseen. Methods that are
    `watched_closely` have every step in contact looked at.
    """
    lane, at, work = s.lane, s.at, s.work
    wanted = np.isnan(work[at.change, lane]) or work[at.arrival, lane] >= work[at.end, lane]
    wanted |= at.watched_closely and touches(s)
    wanted |= s.run.landing != NO_PAIR and turns_before_onset(s)
    due = int(work[at.flag, lane]) & SWINGING != 0 or is_due(s)
    if not (wanted or due):
        return
    place_evenly(0.0, 1.0, s)
    channels_within(s)
    if due:
        wanted |= may_set_extremes(s)
    if not wanted:
        return
    waiting = 0
    for r in range(at.rows):
        waiting = look_at_instants(r, waiting, 0.0, 1.0, s)
    look_at_extremes(waiting, s)


@inner_kernel()
def touches(s: Step) -> bool:
    """Whether a pair is in contact during this step."""
    found = False
    for j in range(s.at.pairs):
        found |= s.work[s.at.mode + j, s.lane] > 0.0
    return found


@inner_kernel()
def place_evenly(low: float, high: float, s: Step) -> None:
    """Place eight instants evenly from one share of a step to another."""
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = low + (high - low) * (i / (INSTANTS - 1))


@inner_kernel()
def look_at_instants(r: int, waiting: int, low: float, high: float, s: Step) -> int:
    """Let extremes of a channel between eight even instants count, if they are sharp.

    Returns how many brackets wait to be looked at more closely, of all channels.
    """
    for i in range(INSTANTS):
        s.table[CLOSER + i] = s.spare[s.at.channel + r, i]
    spacing = (high - low) / (INSTANTS - 1)
    return open_brackets(r, 1, low, spacing, INSTANTS, EXACT, waiting, s)
