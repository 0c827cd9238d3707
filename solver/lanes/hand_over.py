"""Lets the lanes of a bundle go on with the kernel of another method, from where they are."""

from dataclasses import replace

import numpy as np

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import NO_PAIR, Status
from jointplay.solver.lanes.bundle import HANDED_OUT, Bundle
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.lanes.problem import LaneProblem, LaneStart

KEPT = """
total gross potential_start stored_start highest lowest highest_time lowest_time
rounding onset_time approach_rate onset_total largest_step steps pace_at smallest_step rough_until
"""
"""Slots of counts and extremes of lanes, whatever the method."""
SCALES = ("weight", "full", "fastest")
"""Slots in inverse proportion to the tolerance."""


def handed_over(bundle: Bundle, kernel: Kernel, problem: LaneProblem, sharper: float) -> Bundle:
    """Return a bundle of another method of the same scene, whose lanes go on where others are.

    Counters, extremes, energies and contacts go on, too; steps begin as small as those of a run. A
    lane that does not run keeps its status.

    Parameters
    ----------
    problem
        Of the first lane.
    sharper
        Tolerance of each lane before, in the one from here on.
    """
    found = Bundle(kernel, watch=bundle.watch, keep_steps=1)
    every = map(bundle.lane, range(BUNDLE))
    lanes = {i: lane for i, lane in enumerate(every) if lane.status != Status.IDLE}
    row = bundle.kernel.row
    found.load_together(
        {
            i: replace(problem, start=LaneStart.at_row(lane.row()[0], row))
            for i, lane in lanes.items()
        }
    )
    for i, lane in lanes.items():
        _take_over(found.lane(i), lane, sharper)
        found.runs[i] = bundle.runs[i]
        found.first_energy[:, i] = bundle.first_energy[:, i]
        if lane.running:
            found.set_going(i)
        else:
            found.lane(i)["active"] = 0.0
    for name in (*HANDED_OUT, "landings"):
        found.runs[name] = 0
    found.runs["landing"] = NO_PAIR
    found.attempts = bundle.attempts
    return found


def _take_over(lane: Lane, before: Lane, sharper: float) -> None:
    """Give a lane that was loaded with the state of another what that has counted and found."""
    _touch(lane, before)
    _record_ends(before)
    for name in KEPT.split():
        lane[name] = before[name]
    for name in SCALES:
        lane[name] = sharper * before[name]


def _touch(lane: Lane, before: Lane) -> None:
    """Have the same pairs in contact: one that has just begun may be open by rounding."""
    if np.array_equal(lane["mode"], before["mode"]):
        return
    lane["mode"], lane["impact_rate"] = before["mode"], before["impact_rate"]
    lane.kernel.module.right_hand_side(lane.work)
    lane["k1_"], lane["kledger1_"] = lane["slope"], lane["ledger"]


def _record_ends(lane: Lane) -> None:
    """Count the values where a lane's last step ended among its extremes."""
    now = lane["previous"]
    for end, beyond in (("highest", now > lane["highest"]), ("lowest", now < lane["lowest"])):
        rows = np.flatnonzero(beyond)
        lane[end][rows] = now[rows]
        lane[f"{end}_time"][rows] = lane.time
