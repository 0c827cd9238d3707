"""Periods, what is due next, and the end of a lane's run."""

import math

import numpy as np

from jointplay.solver.kernels import compensated
from jointplay.solver.kernels.emit.slots import Slots
from jointplay.solver.kernels.jit import inner_kernel, kernel
from jointplay.solver.kernels.loop.runs import (
    PACE_STEPS,
    SAMPLES,
    SECTIONS,
    SLOWEST_PACE,
    Run,
    SectionKind,
    Status,
)

SAME = 1e-12
"""Share of a period: a section so close to the end of the run is taken there."""
MOST_STEPS = 4e9
"""Accepted steps of one run: days of computing."""

product_difference = kernel()(compensated.product_difference)
"""Time is whole periods plus local time, so that period 10 000 is as sharp as the first."""


@inner_kernel()
def due_time(kind: int, index: int, lane: int, run: Run, at: Slots, work: np.ndarray) -> float:
    """Local time of a sample or section (`kind`); infinite past the last one."""
    whole = float(run.periods)
    if kind == SAMPLES:
        last = run.stop[SAMPLES] - 1
        if index > last:
            return math.inf
        if index == last:
            return work[at.end, lane]
        return product_difference(float(index), run.output_step, whole, run.period)
    if index >= run.stop[SECTIONS] or run.section_kind != SectionKind.CRANK:
        return math.inf
    moment = (float(index) - whole) * run.period + run.section_offset
    end = work[at.end, lane]
    return end if abs(moment - end) <= SAME * run.period else moment


@inner_kernel()
def look_ahead(lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Note when the next sample and the next section are due."""
    for kind in range(2):
        run.due[kind] = due_time(kind, run.next[kind], lane, run, at, work)


@inner_kernel()
def plan(lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Set the next local time at which a lane wants attention."""
    soonest = min(min(run.due[SAMPLES], run.due[SECTIONS]), run.period)
    work[at.next_due, lane] = min(soonest, work[at.end, lane])


@inner_kernel()
def turn_over(lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Begin a new period: local time goes back, and phases on where periods are not common."""
    run.periods += 1
    work[at.time, lane] -= run.period
    work[at.before_time, lane] -= run.period
    for j in range(at.pairs):
        work[at.opened + j, lane] -= run.period
    set_clock(lane, run, at, work)
    look_ahead(lane, run, at, work)


@inner_kernel()
def set_clock(lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Set the end and the clocks as they are in a lane's present period."""
    whole = float(run.periods)
    work[at.end, lane] = product_difference(run.duration, 1.0, whole, run.period)
    for k in range(at.clocks):
        start, turn = work[at.clock_start + k, lane], work[at.clock_turn + k, lane]
        travel = whole * work[at.clock_travel + k, lane]
        if turn == 0.0:
            work[at.phase + k, lane] = start + travel
            continue
        turns = travel if run.common else math.floor(travel)
        work[at.wound + k, lane] = turn * turns
        work[at.phase + k, lane] = start + turn * (travel - turns)


def set_clocks(slots: np.ndarray, work: np.ndarray, runs: np.ndarray) -> None:
    """Set the clocks of all lanes as they are in their present periods; note what is due next."""
    for lane in range(len(runs)):
        set_clock(lane, runs[lane], slots[0], work)
        look_ahead(lane, runs[lane], slots[0], work)


def plan_anew(slots: np.ndarray, work: np.ndarray, runs: np.ndarray, lane: int) -> None:
    """Note what is due next in a lane, and the local time at which it wants attention.

    runs : (1,) that of the lane.
    """
    look_ahead(lane, runs[0], slots[0], work)
    plan(lane, runs[0], slots[0], work)


@inner_kernel()
def stop(status: int, lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Take a lane out of the running."""
    run.status = status
    work[at.active, lane] = 0.0
    work[at.accept, lane] = 0.0


@inner_kernel()
def check_pace(lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Stop a lane that has used up its steps or hardly moves; counted in its own steps."""
    now = float(run.periods) * run.period + work[at.time, lane]
    steps = work[at.steps, lane]
    if now - run.pace_time < SLOWEST_PACE * run.unit:
        stop(Status.NO_PROGRESS, lane, run, at, work)
    elif steps >= MOST_STEPS:
        stop(Status.STEP_LIMIT, lane, run, at, work)
    run.pace_time = now
    work[at.pace_at, lane] = steps + PACE_STEPS
