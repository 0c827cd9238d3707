"""Advances lanes, each at its own step, until all are done or Python has something to do.

The generated functions do what all lanes do alike; `solver.kernels.loop.lanes` looks after the
lanes that need attention. Rules that make a run's bits independent of everything around it:
counters are per lane, and only onsets, openings, knots of functions and the end of the run ever
shorten a step.
"""

import numpy as np

from jointplay.solver.kernels.loop import calls
from jointplay.solver.kernels.loop.events import any_crossing
from jointplay.solver.kernels.loop.lanes import (
    any_accepted,
    attend_lanes,
    count_active,
    cross_lanes,
    keep_steps,
    landing_lanes,
    look_closer_at_lanes,
    refine_lanes,
    settle_lanes,
)
from jointplay.solver.kernels.loop.runs import Buffers
from jointplay.solver.kernels.loop.step import group_of
from jointplay.solver.kernels.loop.unowned_view import unowned
from jointplay.solver.kernels.loop.workspace import Workspace


def advance(given: Workspace, buffers: Buffers, watch: int, budget: int) -> int:
    """Make at most `budget` attempts at a step; fewer if a lane ends or a buffer is full.

    Parameters
    ----------
    buffers
        Rows that are handed out; where they have no room for growths, there are no tangents.
    watch
        Whether the extremes of channels are sought.

    Returns
    -------
    int
        How many attempts were made.
    """
    group = group_of(given)
    at, work, runs, call = group.at, group.work, group.runs, group.call
    marked = unowned(work.view(np.uint64))
    rows, steps = unowned(buffers.rows), unowned(buffers.steps)
    running, landing, crossing = count_active(at, work), landing_lanes(runs), any_crossing(runs)
    tangents = buffers.growths.shape[1] > 0
    for lane in range(len(runs)):
        work[at.looks_inside, lane] = float(watch or crossing)
    made = 0
    while made < budget and running > 0:
        made += 1
        wanted = calls.attempt(call, work) | landing
        full = wanted != 0 and attend_lanes(wanted, group, rows)
        if watch or crossing:
            calls.observe(call, work)
        if crossing:
            crossed, filled = cross_lanes(group, rows)
            wanted, full = wanted | crossed, full or filled
        quiet = wanted == 0
        if watch:
            foreseen = calls.foresee_looks(call, work)
            if foreseen != 0:
                calls.foresee_bends(call, work)
            if foreseen | wanted != 0:
                look_closer_at_lanes(foreseen | wanted, group)
        if watch or crossing:  # a scan also keeps the values from which channels go on
            candidates = calls.scan(call, work) if quiet else calls.scan_some(call, work)
            if watch and candidates > 0:
                refine_lanes(candidates, group, marked)
        if watch:
            calls.remember(call, work) if quiet else calls.remember_some(call, work)
        full |= keep_steps(group, steps)
        if tangents and (quiet or any_accepted(at, work)):
            calls.tangent_step(call, work)
        calls.take(call, work)
        if quiet and not full:
            continue
        full |= settle_lanes(wanted, group, buffers)
        still, landing = count_active(at, work), landing_lanes(runs)
        if full or still < running:  # a free lane may have a new problem waiting
            break
        running = still
    return made
