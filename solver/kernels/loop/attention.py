"""Attention to one lane: between its attempt at a step and the commit, and once it is taken.

A rejected step, a contact that begins or ends, a sample or section that is due, the end of a period
or of the run.
"""

import math

import numpy as np

from jointplay.solver.kernels.emit.judging import DUE, ONSET, PACE, REJECTED, RELEASE
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.contacts import (
    CAUTIOUS,
    begin_abruptly,
    begin_contact,
    end_contact,
    is_touching,
    land,
    lands_beside,
)
from jointplay.solver.kernels.loop.dense_rows import hand_out
from jointplay.solver.kernels.loop.events import has_all_events, record_event
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import count_end
from jointplay.solver.kernels.loop.onset import forget_looks
from jointplay.solver.kernels.loop.openings import LATE, end_behind_opening, note_openings
from jointplay.solver.kernels.loop.periods import check_pace, plan, stop, turn_over
from jointplay.solver.kernels.loop.runs import NO_PAIR, Buffers, SectionKind, Status
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.loop.tangent import forget_latched, latch_tangent, record_growth

AT_ONSET = 1e-4
"""Share of a run's smallest step that one may have which begins where contact does: a force that
grows as a root of time may ask for it. So short a one need not move time, but it moves the rest."""


@inner_kernel()
def attend(flag: int, s: Step, rows: np.ndarray) -> bool:
    """Look after one lane between its attempt and its commit. Returns whether a buffer is full."""
    lane, run, at, work = s.lane, s.run, s.at, s.work
    run.attended += 1
    opening = 1.0
    forget_looks(s)
    if flag & RELEASE:
        opening = note_openings(s, not flag & REJECTED)
    if flag & REJECTED:
        run.rejections += 1
        run.landing = NO_PAIR  # its attempts count on, or they might go in circles
        touching = is_touching(s)
        smallest = run.smallest_step * AT_ONSET if touching else run.smallest_step
        if work[at.next_step, lane] < smallest:
            stop(Status.UNDERFLOW, lane, run, at, work)
            return False
        if touching:
            work[at.next_step, lane] *= CAUTIOUS
    if opening < LATE:
        end_behind_opening(opening, s)
        return False
    if flag & REJECTED:
        return False
    if (flag & ONSET or run.landing != NO_PAIR) and not land(s):
        work[at.accept, lane] = 0.0
        return False
    return flag & DUE != 0 and hand_out(s, rows)


@inner_kernel()
def settle(flag: int, s: Step, buffers: Buffers) -> bool:
    """Look after one lane once its step is taken. Returns whether a buffer is nearly full."""
    lane, run, at, work, addresses = s.lane, s.run, s.at, s.work, s.addresses
    tangents = buffers.growths.shape[1] > 0
    begun = float(run.periods) * run.period
    now = begun + work[at.time, lane]
    full = False
    landed = run.landing
    if landed != NO_PAIR:
        abrupt = False
        for j in range(at.pairs):
            if j != landed and not lands_beside(j, s):
                continue
            begin_contact(j, now, s)
            # where a fixed step ends, a contact may begin deep: with energy from nowhere
            generated.weigh(addresses, work)
            work[at.stored_start, lane] = work[at.stored, lane]
            if tangents:
                generated.tangent_penetrations(addresses, work)
                latch_tangent(j, s)
            run.onsets += 1
            run.slow += int(work[at.approach_rate + j, lane] < work[at.impact_floor + j, lane])
            if run.section_kind == SectionKind.ONSET and run.section_index == j:
                full |= record_event(lane, s, work, buffers.rows)
            abrupt |= work[at.abrupt + j, lane] > 0.0
        if abrupt:
            begin_abruptly(landed, s)
        run.landing = NO_PAIR
        run.landings = 0
    if flag & RELEASE:
        for j in range(at.pairs):
            opened = work[at.opened + j, lane]
            if work[at.mode + j, lane] > 0.0 and opened < math.inf:
                work[at.mode + j, lane] = 0.0
                end_contact(j, begun + opened, s, buffers.impacts)
        full |= run.impacts + at.pairs > buffers.impacts.shape[1]
    if work[at.time, lane] >= work[at.end, lane] or has_all_events(run):
        count_end(now, s)
        if tangents:
            full |= record_growth(now, s, buffers.growths)
        for j in range(at.pairs):
            if work[at.mode + j, lane] > 0.0:
                end_contact(j, math.nan, s, buffers.impacts)
        stop(Status.DONE, lane, run, at, work)
        return full
    if flag & PACE:
        check_pace(lane, run, at, work)
    if flag & DUE:
        if work[at.time, lane] >= run.period:
            turn_over(lane, run, at, work)
            if tangents:
                full |= record_growth(now, s, buffers.growths)
                if run.periods == run.tangent_forgets:
                    forget_latched(s)
        plan(lane, run, at, work)
    return full
