"""Advances lanes, each at its own step, until all are done or Python has something to do.

The generated functions do what all lanes do alike; `solver.kernels.loop.lanes` looks after the
lanes that need attention. Rules that make a run's bits independent of everything around it:
counters are per lane, and only onsets, openings, knots of functions and the end of the run ever
shorten a step.
"""

import numpy as np

from jointplay.solver.kernels.loop import generated
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
    seeking_lanes,
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
    at, work, runs, addresses = group.at, group.work, group.runs, group.addresses
    marked = unowned(work.view(np.uint64))
    rows, steps = unowned(buffers.rows), unowned(buffers.steps)
    running, landing, crossing = count_active(at, work), landing_lanes(runs), any_crossing(runs)
    tangents = buffers.growths.shape[1] > 0
    seeking = seeking_lanes(at, work) if watch else 0
    for lane in range(len(runs)):
        work[at.looks_inside, lane] = float(seeking >> lane & 1 or crossing)
    made = 0
    while made < budget and running > 0:
        made += 1
        wanted = generated.attempt(addresses, work) | landing
        full = wanted != 0 and attend_lanes(wanted, group, rows)
        if seeking or crossing:
            generated.observe(addresses, work)
        if crossing:
            crossed, filled = cross_lanes(group, rows)
            wanted, full = wanted | crossed, full or filled
        quiet = wanted == 0
        if seeking:
            foreseen = generated.foresee_looks(addresses, work) & seeking
            if foreseen != 0:
                generated.foresee_bends(addresses, work)
            if (foreseen | wanted) & seeking != 0:
                look_closer_at_lanes((foreseen | wanted) & seeking, group)
        if seeking or crossing:  # a scan also keeps the values from which channels go on
            candidates = (
                generated.scan(addresses, work) if quiet else generated.scan_some(addresses, work)
            )
            if seeking and candidates > 0:
                refine_lanes(candidates, group, marked)
        if seeking:
            generated.remember(addresses, work) if quiet else generated.remember_some(
                addresses, work
            )
        full |= keep_steps(group, steps)
        if tangents and (quiet or any_accepted(at, work)):
            generated.tangent_step(addresses, work)
        generated.take(addresses, work)
        if quiet and not full:
            continue
        full |= settle_lanes(wanted, group, buffers)
        still, landing = count_active(at, work), landing_lanes(runs)
        if full or still < running:  # a free lane may have a new problem waiting
            break
        running = still
    return made
