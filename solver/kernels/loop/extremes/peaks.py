"""Extremes of channels, sought inside the steps: never read off step ends or output samples."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.kinks_beside import look_at_kinks_beside
from jointplay.solver.kernels.loop.extremes.search.brackets import MOST_ROUNDS, NODES
from jointplay.solver.kernels.loop.extremes.search.extreme_so_far import count_best, spread
from jointplay.solver.kernels.loop.extremes.search.local_extremes import open_brackets
from jointplay.solver.kernels.loop.extremes.search.narrowing import PER_STEP
from jointplay.solver.kernels.loop.extremes.search.rounding import zigzags
from jointplay.solver.kernels.loop.extremes.search.seeking import FORETOLD, seek
from jointplay.solver.kernels.loop.step import Step, channels_around

ONE_OF_EIGHT = 0x0101010101010101
BYTES = 8
"""Rows whose marks are looked at together."""


@inner_kernel()
def refine_peaks(s: Step, marked: np.ndarray) -> None:
    """Seek the extremes that the scan suspects around the start of this step.

    Candidate channels are evaluated at quarters of the step before and of this one. `marked` :
    `work`, whose bytes are the scan's.
    """
    for i in range(INSTANTS):
        s.spare[s.at.theta, i] = (i % PER_STEP) / PER_STEP
    channels_around(s)
    rows, waiting = np.empty(s.at.rows, np.int64), 0
    rows = rows[: find_marked(s, marked[s.at.marked :], rows)]
    for r in rows:
        waiting = look_at_quarters(r, waiting, s)
    waiting = look_at_kinks_beside(rows, waiting, s)
    leave_rounding(waiting, s)
    seek(waiting, s)


@inner_kernel(borrows=True)
def find_marked(s: Step, marked: np.ndarray, rows: np.ndarray) -> int:
    """Write the rows that the scan marked for a lane.

    Returns how many. `marked` : from the marks on.
    """
    count = 0
    lanes, lanes_bits = marked.shape[1], np.uint64(ONE_OF_EIGHT << s.lane)
    for word in range((s.at.rows + BYTES - 1) // BYTES):
        bits = marked[word // lanes, word % lanes] & lanes_bits
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
        values = s.brackets[waiting].seen
        for i in range(PER_STEP):
            values[i] = s.spare[at.channel + r, PER_STEP * step + i]
        values[PER_STEP] = end if step else junction
        waiting = open_brackets(r, step, 0.0, 1.0 / PER_STEP, NODES, FORETOLD, waiting, s)
    return waiting


@inner_kernel(borrows=True)
def leave_rounding(waiting: int, s: Step) -> None:
    """Let the values of brackets count as they are where a channel is nothing but rounding."""
    for k in range(waiting):
        bracket = s.brackets[k]
        if zigzags(bracket.values, NODES):
            least = s.work[s.at.rounding + bracket.row, s.lane]
            if spread(bracket.row, bracket.value, s) <= least:
                count_best(bracket, s)
                bracket.rounds = MOST_ROUNDS
