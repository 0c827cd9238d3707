"""Rows of accepted steps: written as each is taken, and read to make the same step again."""

import math

import numpy as np

from jointplay.solver.kernels.emit.slots import LENGTH, PERIOD, TIME, Slots
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.periods import set_clock
from jointplay.solver.kernels.loop.runs import Run


@inner_kernel()
def write_step(row: np.ndarray, lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Write the step that a lane is about to take, as `StepRow` arranges it."""
    columns = at.step_row
    row[PERIOD] = run.periods
    row[TIME] = work[at.time, lane]
    row[LENGTH] = work[at.tried, lane]
    for k in range(at.states):
        row[columns.state + k] = work[at.y + k, lane]
    for k in range(columns.coordinates, at.states):
        row[columns.slope + k - columns.coordinates] = work[at.k1_ + k, lane]
    for j in range(at.pairs):
        row[columns.mode + j] = work[at.mode + j, lane]
        row[columns.impact_rate + j] = work[at.impact_rate + j, lane]


@inner_kernel()
def read_step(row: np.ndarray, lane: int, run: Run, at: Slots, work: np.ndarray) -> None:
    """Set a lane to the start of a step, which the next attempt makes again, bit for bit.

    Its stage is there, too.
    """
    columns, count = at.step_row, at.step_row.coordinates
    run.periods = int(row[PERIOD])
    set_clock(lane, run, at, work)
    work[at.end, lane] = work[at.largest_step, lane] = math.inf
    work[at.active, lane] = 1.0
    work[at.time, lane] = work[at.stage_time, lane] = row[TIME]
    work[at.step, lane] = row[LENGTH]
    for k in range(at.states):
        work[at.y + k, lane] = work[at.stage + k, lane] = row[columns.state + k]
    for k in range(count):  # the slope of a coordinate is its speed
        work[at.k1_ + k, lane] = row[columns.state + count + k]
    for k in range(count, at.states):
        work[at.k1_ + k, lane] = row[columns.slope + k - count]
    for j in range(at.pairs):
        work[at.mode + j, lane] = row[columns.mode + j]
        work[at.impact_rate + j, lane] = row[columns.impact_rate + j]


@inner_kernel()
def read_steps(steps: np.ndarray, first: int, runs: np.ndarray, at: Slots, work: np.ndarray) -> int:
    """Set all lanes to steps from index `first` on, and return how many of them there are.

    Lanes for which none is left repeat the last one.
    """
    lanes = work.shape[1]
    count = min(lanes, len(steps) - first)
    for lane in range(lanes):
        read_step(steps[first + min(lane, count - 1)], lane, runs[lane], at, work)
    return count
