"""Extremes inside steps that no scan of step ends finds.

Where a run begins or ends there is no step beside that would tell that a channel turned; in long
steps of a contact, which a method of high order or of fixed steps takes, anything may happen; and
steps at the limit of stability swing inside.
"""

import numpy as np

from jointplay.solver.kernels.emit.judging import SWINGING
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.even_instants import place_evenly, seek_between
from jointplay.solver.kernels.loop.extremes.roughness import is_due, may_set_extremes
from jointplay.solver.kernels.loop.extremes.turns_before_onset import turns_before_onset
from jointplay.solver.kernels.loop.runs import NO_PAIR
from jointplay.solver.kernels.loop.step import Step, channels_within


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
    seek_between(np.arange(at.rows), 0.0, 1.0, s)


@inner_kernel()
def touches(s: Step) -> bool:
    """Whether a pair is in contact during this step."""
    found = False
    for j in range(s.at.pairs):
        found |= s.work[s.at.mode + j, s.lane] > 0.0
    return found
