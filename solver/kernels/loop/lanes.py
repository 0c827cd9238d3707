"""Loops over the lanes of a group: which of them need what, while one attempt is looked after.

Sets of lanes are words: bit k is set for lane k.
"""

import numpy as np

from jointplay.solver.kernels.emit.slots import Slots
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.accepted_steps import write_step
from jointplay.solver.kernels.loop.attention import attend, settle
from jointplay.solver.kernels.loop.events import may_cross, record_crossings
from jointplay.solver.kernels.loop.extremes.closer_look import look_closer
from jointplay.solver.kernels.loop.extremes.peaks import refine_peaks
from jointplay.solver.kernels.loop.runs import NO_PAIR, Buffers
from jointplay.solver.kernels.loop.step import Group, step_of


@inner_kernel()
def count_active(at: Slots, work: np.ndarray) -> int:
    """Return how many lanes run."""
    running = 0
    for lane in range(work.shape[1]):
        if work[at.active, lane] > 0.0:
            running += 1
    return running


@inner_kernel()
def any_accepted(at: Slots, work: np.ndarray) -> bool:
    """Return whether a lane takes the step that was just judged."""
    accepted = 0.0
    for lane in range(work.shape[1]):
        accepted += work[at.accept, lane]
    return accepted > 0.0


@inner_kernel()
def landing_lanes(runs: np.ndarray) -> int:
    """Return the lanes that are about to land on an onset."""
    landing = 0
    for lane in range(len(runs)):
        if runs[lane].landing != NO_PAIR:
            landing |= 1 << lane
    return landing


@inner_kernel()
def seeking_lanes(at: Slots, work: np.ndarray) -> int:
    """Return the lanes that seek extremes: in the others no value is beyond those so far."""
    seeking = 0
    for lane in range(work.shape[1]):
        endless = work[at.highest, lane] == np.inf and work[at.lowest, lane] == -np.inf
        if not endless:
            seeking |= 1 << lane
    return seeking


@inner_kernel(borrows=True)
def attend_lanes(wanted: int, group: Group, rows: np.ndarray) -> bool:
    """Look after lanes between their attempts and the commit. Returns whether a buffer is full."""
    full = False
    for lane in range(len(group.runs)):
        s = step_of(lane, group)
        if wanted >> lane & 1 and s.work[s.at.active, lane] > 0.0:
            full |= attend(int(s.work[s.at.flag, lane]), s, rows)
    return full


@inner_kernel(borrows=True)
def cross_lanes(group: Group, rows: np.ndarray) -> tuple[int, bool]:
    """Write sections where channels cross.

    Returns the lanes in which one may, and whether a buffer is full.
    """
    crossed, full = 0, False
    for lane in range(len(group.runs)):
        s = step_of(lane, group)
        if s.work[s.at.accept, lane] > 0.0 and may_cross(s):
            crossed |= 1 << lane
            full |= record_crossings(s, rows)
    return crossed, full


@inner_kernel(borrows=True)
def look_closer_at_lanes(wanted: int, group: Group) -> None:
    """Seek extremes that no scan of step ends finds, in the steps that lanes take."""
    for lane in range(len(group.runs)):
        s = step_of(lane, group)
        if wanted >> lane & 1 and s.work[s.at.accept, lane] > 0.0:
            look_closer(s)


@inner_kernel(borrows=True)
def refine_lanes(candidates: int, group: Group, marked: np.ndarray) -> None:
    """Seek the extremes that the scan suspects in the steps that lanes take."""
    for lane in range(len(group.runs)):
        if candidates >> lane & 1 and group.work[group.at.accept, lane] > 0.0:
            refine_peaks(step_of(lane, group), marked)


@inner_kernel(borrows=True)
def keep_steps(group: Group, steps: np.ndarray) -> bool:
    """Write the steps that lanes take which keep them. Returns whether a buffer is full now."""
    full = False
    for lane in range(len(steps)):
        if group.work[group.at.accept, lane] > 0.0:
            run = group.runs[lane]
            write_step(steps[lane, run.kept], lane, run, group.at, group.work)
            run.kept += 1
            full |= run.kept == steps.shape[1]
    return full


@inner_kernel(borrows=True)
def settle_lanes(wanted: int, group: Group, buffers: Buffers) -> bool:
    """Look after lanes whose steps are taken. Returns whether a buffer is nearly full."""
    full = False
    for lane in range(len(group.runs)):
        s = step_of(lane, group)
        if wanted >> lane & 1 and s.work[s.at.accept, lane] > 0.0:
            full |= settle(int(s.work[s.at.flag, lane]), s, buffers)
    return full
