"""Makes stored steps again, and evaluates states inside them as the run would have."""

import numpy as np

from jointplay.solver.kernels.emit.slots import LENGTH, PERIOD, TIME
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.accepted_steps import read_step, read_steps
from jointplay.solver.kernels.loop.dense_rows import write_row
from jointplay.solver.kernels.loop.periods import product_difference
from jointplay.solver.kernels.loop.runs import Run
from jointplay.solver.kernels.loop.step import group_of
from jointplay.solver.kernels.loop.workspace import Workspace


@inner_kernel()
def moment_of(i: int, moments: np.ndarray, row: np.ndarray, run: Run) -> float:
    """Return an instant as local time of the period that a step is in, s."""
    return product_difference(moments[i, 0], moments[i, 1], row[PERIOD], run.period)


def find_steps(runs: np.ndarray, steps: np.ndarray, moments: np.ndarray, found: np.ndarray) -> None:
    """Find the step that each instant is in: the first that does not end before it.

    Parameters
    ----------
    steps : (n, width)
        Consecutive steps, as `write_step` wrote them.
    moments : (m, 2)
        Instants in ascending order, each the product of two numbers, s.
    found : (m,)
        Where the steps' indices are written; n for an instant behind them all.
    """
    k = 0
    for i in range(len(moments)):
        while k < len(steps):
            row = steps[k]
            if moment_of(i, moments, row, runs[0]) <= row[TIME] + row[LENGTH]:
                break
            k += 1
        found[i] = k


def states_in_steps(
    given: Workspace, steps: np.ndarray, moments: np.ndarray, found: np.ndarray, rows: np.ndarray
) -> None:
    """Write dense states at instants inside steps, bit for bit those that the run hands out.

    Parameters
    ----------
    given
        Lanes that have the scene's numbers, and runs with its period; the rest is overwritten.
    steps, moments, found
        As `find_steps` takes them; steps without an instant are not made again.
    rows : (m, width)
        Where dense rows are written.
    """
    group = group_of(given)
    at, work, spare, runs = group.at, group.work, group.spare, group.runs
    addresses = group.addresses
    lanes, done = work.shape[1], 0
    begins = np.empty(lanes + 1, np.int64)
    while done < len(found):
        busy, i = 0, done
        while i < len(found) and busy < lanes:
            begins[busy] = i
            read_step(steps[found[i]], busy, runs[busy], at, work)
            while i < len(found) and found[i] == found[begins[busy]]:
                i += 1
            busy += 1
        begins[busy] = i
        for lane in range(busy, lanes):
            read_step(steps[found[done]], lane, runs[lane], at, work)
        generated.attempt(addresses, work)
        for lane in range(busy):
            start, tried = work[at.time, lane], work[at.tried, lane]
            for first in range(begins[lane], begins[lane + 1], INSTANTS):
                count = min(INSTANTS, begins[lane + 1] - first)
                for k in range(count):
                    moment = moment_of(first + k, moments, steps[found[first]], runs[lane])
                    theta = (moment - start) / tried if tried > 0.0 else 0.0
                    spare[at.theta, k] = min(max(theta, 0.0), 1.0)
                generated.states_within(addresses, work, spare, lane)
                for k in range(count):
                    write_row(rows[first + k], k, lane, runs[lane], at, work, spare)
        done = i


def make_again(given: Workspace, steps: np.ndarray, ends: np.ndarray, works: np.ndarray) -> None:
    """Make steps (n, width) again, in lanes as `states_in_steps` takes them.

    Writes the states (n, states) that they end with, and what they add to the terms of the energy
    ledger, (n, terms), J.
    """
    group = group_of(given)
    at, work, addresses = group.at, group.work, group.addresses
    for first in range(0, len(steps), work.shape[1]):
        count = read_steps(steps, first, group.runs, at, work)
        generated.right_hand_side(addresses, work)
        generated.weigh(addresses, work)
        for lane in range(work.shape[1]):
            work[at.stored_start, lane] = work[at.stored, lane]
            for k in range(at.ledger):
                work[at.kledger1_ + k, lane] = work[at.power + k, lane]
                work[at.total + k, lane] = 0.0
        generated.attempt(addresses, work)
        for lane in range(count):
            for k in range(at.states):
                ends[first + lane, k] = work[at.stage + k, lane]
        for lane in range(work.shape[1]):
            work[at.accept, lane] = 1.0
        generated.take(addresses, work)
        for lane in range(count):
            for k in range(works.shape[1]):
                works[first + lane, k] = work[at.total + k, lane]
