"""Rows of dense state: written for samples and sections, and read again to evaluate channels."""

import numpy as np

from jointplay.solver.kernels.emit.slots import PERIOD, TIME, Slots
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.periods import due_time
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.step import Step, states_within


@inner_kernel()
def write_row(
    row: np.ndarray, i: int, lane: int, run: Run, at: Slots, work: np.ndarray, source: np.ndarray
) -> None:
    """Write the dense state in column i of `source`, a lane's, as `DenseRow` arranges it."""
    row[PERIOD] = run.periods
    row[TIME] = source[at.stage_time, i]
    for k in range(at.clocks):
        row[at.row.phase + k] = work[at.phase + k, lane]
        row[at.row.wound + k] = work[at.wound + k, lane]
    for k in range(at.states):
        row[at.row.state + k] = source[at.stage + k, i]
    for j in range(at.pairs):
        row[at.row.mode + j] = source[at.mode + j, i]
        row[at.row.impact_rate + j] = source[at.impact_rate + j, i]


@inner_kernel()
def read_row(row: np.ndarray, i: int, at: Slots, target: np.ndarray) -> None:
    """Set column i of a work array to a dense state."""
    target[at.stage_time, i] = row[TIME]
    for k in range(at.clocks):
        target[at.phase + k, i] = row[at.row.phase + k]
        target[at.wound + k, i] = row[at.row.wound + k]
    for k in range(at.states):
        target[at.stage + k, i] = row[at.row.state + k]
    for j in range(at.pairs):
        target[at.mode + j, i] = row[at.row.mode + j]
        target[at.impact_rate + j, i] = row[at.row.impact_rate + j]


@inner_kernel()
def hand_out(s: Step, rows: np.ndarray) -> bool:
    """Write the samples and sections inside this step.

    Returns whether a buffer was too full for them.

    A full buffer postpones the step: the same attempt is made again once there is room.
    """
    lane, run, at, work = s.lane, s.run, s.at, s.work
    arrival = work[at.arrival, lane]
    start, tried = work[at.time, lane], work[at.tried, lane]
    for kind in range(2):
        while run.due[kind] <= arrival:
            count = 0
            moment = run.due[kind]
            while count < INSTANTS and moment <= arrival:
                theta = (moment - start) / tried if tried > 0.0 else 0.0
                s.spare[at.theta, count] = min(max(theta, 0.0), 1.0)
                count += 1
                moment = due_time(kind, run.next[kind] + count, lane, run, at, work)
            if run.filled[kind] + count > rows.shape[2]:
                work[at.accept, lane] = 0.0
                work[at.resumed, lane] = work[at.next_step, lane]  # which it asks for again
                work[at.next_step, lane] = work[at.step, lane]
                return True
            states_within(s)
            for i in range(count):
                write_row(rows[kind, lane, run.filled[kind]], i, lane, run, at, work, s.spare)
                run.filled[kind] += 1
            run.next[kind] += count
            run.due[kind] = moment
    return False


def observe_rows(
    addresses: np.ndarray,
    slots: np.ndarray,
    work: np.ndarray,
    blank: np.ndarray,
    lane: int,
    rows: np.ndarray,
    columns: np.ndarray,
    out: np.ndarray,
) -> None:
    """Evaluate channels of a lane at rows of dense state, as many at a time as there are lanes.

    Parameters
    ----------
    blank : (slots, lanes)
        Work array of its own.
    rows : (count, width)
        As `write_row` wrote them.
    columns : (channels,)
        Rows of the channel block.
    out : (count, channels)
        In the channels' units.
    """
    functions, at = addresses[0], slots[0]
    lanes = blank.shape[1]
    for s in range(at.numbers, at.size):
        for i in range(lanes):
            blank[s, i] = work[s, lane]
    for first in range(0, len(rows), lanes):
        count = min(lanes, len(rows) - first)
        for i in range(lanes):
            read_row(rows[first + min(i, count - 1)], i, at, blank)
        generated.right_hand_side(functions, blank)
        generated.observe(functions, blank)
        generated.observe_rest(functions, blank)
        for i in range(count):
            for c in range(len(columns)):
                out[first + i, c] = blank[at.channel + columns[c], i]
