"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.brackets import (
    ABSCISSA,
    BRACKETS,
    CLOSER,
    COLUMN,
    FOUND,
    IN_THIS,
    ROUNDS,
    ROW,
    SPACING,
    START,
    STRIDE,
)
from jointplay.solver.kernels.loop.extreme import NODES
from jointplay.solver.kernels.loop.kinks_beside import look_at_kinks_beside
from jointplay.solver.kernels.loop.seeking import FORETOLD, HALF, MOST_ROUNDS, is_done_by, seek
from jointplay.solver.kernels.loop.step import Step, channels_around
from jointplay.solver.kernels.loop.tops import open_brackets

ONE_OF_EIGHT = 0x0101010101010101
BYTES = 8
"""Rows whose marks are looked at together."""


@inner_kernel()
def refine_peaks(s: Step, marked: np.ndarray) -> None:
    """Seek the extremes that the scan suspects around the start of this step.

    Candidate channels are evaluated at quarters of the step before and of this one. `marked` :
    `work`, seen as bytes of the scan. `table` : see `solver.kernels.loop.brackets`.
    """
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = (i % HALF) / HALF
    channels_around(s)
    rows, waiting = np.empty(s.at.rows, np.int64), 0
    rows = rows[: find_marked(s, marked[s.at.marked * s.work.shape[1] :], rows)]
    for r in rows:
        waiting = look_at_quarters(r, waiting, s)
    waiting = look_at_kinks_beside(rows, waiting, s)
    look_at_extremes(waiting, s)


@inner_kernel(borrows=True)
def find_marked(s: Step, marked: np.ndarray, rows: np.ndarray) -> int:
    """Write the rows that the scan marked for a lane.

    Returns how many. `marked` : from the marks on.
    """
    count = 0
    lanes_bits = np.uint64(ONE_OF_EIGHT << s.lane)
    for word in range((s.at.rows + BYTES - 1) // BYTES):
        bits = marked[word] & lanes_bits
        if bits != 0:
            for r in range(min(BYTES, s.at.rows - BYTES * word)):  # no marks beyond
                if bits >> np.uint64(8 * r + s.lane) & np.uint64(1):
                    rows[count] = BYTES * word + r
                    count += 1
    return count


@inner_kernel(forceinline=True, borrows=True)
def look_at_quarters(r: int, waiting: int, s: Step) -> int:
    """Let extremes of a channel in the step before and in this one count, if they are sharp.

    Returns how many brackets wait to be looked at more closely, of all channels.
    """
    lane, at, work = s.lane, s.at, s.work
    end = work[at.previous + r, lane]
    junction = end - work[at.change + r, lane]
    for step in range(2):
        for i in range(HALF):
            s.table[CLOSER + i] = s.spare[at.channel + r, HALF * step + i]
        s.table[CLOSER + HALF] = end if step else junction
        waiting = open_brackets(r, step, 0.0, 1.0 / HALF, NODES, FORETOLD, waiting, s)
    return waiting


@inner_kernel(borrows=True)
def look_at_extremes(waiting: int, s: Step) -> None:
    """Evaluate the channels of brackets where their extremes seem to be, many at once.

    Mostly that makes them sharp; the others are sought one after the other.
    """
    if look_where_foretold(waiting, s) > 0:
        seek(waiting, s)


@inner_kernel(borrows=True)
def look_where_foretold(waiting: int, s: Step) -> int:
    """Evaluate the channels of brackets where their extremes seem to be.

    Returns how many are not sharp.
    """
    table = s.table
    done = 0
    while done < waiting:
        early, late = 0, HALF
        behind = done
        while behind < waiting and early < HALF and late < INSTANTS:
            w = BRACKETS + STRIDE * behind
            column = late if table[w + IN_THIS] else early
            early, late = (early, late + 1) if table[w + IN_THIS] else (early + 1, late)
            share = table[w + START] + table[w + ABSCISSA] * table[w + SPACING]
            s.spare[s.at.theta, column] = share
            table[w + COLUMN] = column
            behind += 1
        channels_around(s)
        for k in range(done, behind):
            w = BRACKETS + STRIDE * k
            table[w + FOUND] = s.spare[s.at.channel + int(table[w + ROW]), int(table[w + COLUMN])]
        done = behind
    unsharp = 0
    for k in range(waiting):
        w = BRACKETS + STRIDE * k
        table[w + ROUNDS] = 0.0
        if is_done_by(table[w + FOUND], w, s):
            table[w + ROUNDS] = MOST_ROUNDS
        else:
            unsharp += 1
    return unsharp


@inner_kernel()
def end_peaks(now: float, s: Step) -> None:
    """Let the values at the run's last instant count as extremes."""
    lane, at, work = s.lane, s.at, s.work
    for r in range(at.rows):
        value = work[at.previous + r, lane]
        if value > work[at.highest + r, lane]:
            work[at.highest + r, lane] = value
            work[at.highest_time + r, lane] = now
        if value < work[at.lowest + r, lane]:
            work[at.lowest + r, lane] = value
            work[at.lowest_time + r, lane] = now
