"""Evaluates a lane's start: first slopes, contacts that begin closed, first extremes, tangent."""

import math

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.knots import AT_ENDS
from jointplay.solver.kernels.emit.stepping import ENDS
from jointplay.solver.kernels.loop.lane import Lane
from jointplay.solver.kernels.loop.problem import LaneProblem
from jointplay.solver.kernels.loop.tangent import start_tangent
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.impact_floors import resting_rate
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

CLOSING_STEPS = 8
"""Newton steps that close the loops of a given start."""


def begin(
    lane: Lane, problem: LaneProblem, resting: Floats, obstructed: bool | Flags = False
) -> None:
    """Evaluate a lane's start: first slopes, contacts that begin closed, first extremes.

    Or that of all lanes of a work array; then `resting`, m/s as `resting_rates` returns them, is
    (pairs, lanes), and `obstructed`, where no tangent can follow, (lanes,).
    """
    module, start = lane.kernel.module, problem.start
    lane["stage"] = lane["y"]
    if start is not None and not start.closed and lane.kernel.equations.loops is not None:
        _close_loops(lane)
    floor = lane["impact_floor"]
    lane["mode"], lane["impact_rate"] = 0.0, floor
    module.right_hand_side(lane.work)
    rate, closed = lane["gap_rate"], lane["gap"] > 0.0
    latched: Floats = np.maximum(rate, resting)
    if start is not None and start.contact is not None and start.impact_rate is not None:
        latched = np.where(start.contact, start.impact_rate, rate)
    lane["mode"], lane["impact_rate"] = 1.0 * closed, np.maximum(latched, floor)
    lane["approach"] = rate
    lane["onset_time"] = lane["onset_total"] = 0.0
    module.right_hand_side(lane.work)
    lane["k1_"], lane["kledger1_"] = lane["slope"], lane["ledger"]
    lane["total"] = 0.0
    module.weigh(lane.work)
    for quantity in ("potential", "stored", "eccentricity", *ENDS, *AT_ENDS):
        lane[f"{quantity}_start"] = lane[quantity]
    lane["resumed"] = lane["gross"] = 0.0
    module.observe(lane.work)
    rows = lane.kernel.rows.scanned
    for kind in ("previous", "highest", "lowest"):
        lane[kind] = lane["channel"][:rows]
    lane["highest_time"] = lane["lowest_time"] = 0.0
    lane["change"] = math.nan
    lane["lowest"][rows - len(floor) :] = -math.inf
    if lane.tangents is not None:
        _start_tangent(lane, obstructed)


def resting_rates(scene: Scene) -> Floats:
    """Return the least impact rate of each pair that touches from the start on, m/s.

    (pairs,), or (pairs, points) if the scene has the numbers of many points.
    """
    length = shortest_link(scene)
    pairs = contact_pairs(scene).values()
    rates = [resting_rate(scene, pair, length) for pair in pairs]
    return np.array(np.broadcast_arrays(*rates), np.float64) if rates else np.zeros(0)


def _close_loops(lane: Lane) -> None:
    """Move a start to where loops are closed, and leave the stages of other lanes alone."""
    stages = lane.work[lane.kernel.layout.block("stage")]
    others = stages.copy()
    for _ in range(CLOSING_STEPS):
        lane.kernel.module.project(lane.work)
    lane["y"] = lane["stage"]
    stages[:] = others
    lane["stage"] = lane["y"]


def _start_tangent(lane: Lane, obstructed: bool | Flags) -> None:
    """Give a lane its first tangent; its state is in the stage still.

    Where a law jumps there is none: the tangent is NaN, and so is its growth.
    """
    assert lane.tangents is not None  # noqa: S101  (asked before)
    columns = range(lane.work.shape[1])
    for index in columns[lane.index] if isinstance(lane.index, slice) else (lane.index,):
        start_tangent(index, lane.slots[0], lane.work)
    lane.tangents.module.kinks(lane.work)
    lane["kink_start"] = lane["kink_end"]
    if lane.kernel.equations.loops is not None:
        accepting = lane.work[lane.slots[0]["accept"]]
        others = accepting.copy()
        accepting[:] = 0.0
        lane["accept"] = 1.0
        lane.tangents.module.hold_tangent(lane.work)
        accepting[:] = others
    lane["tangent"] = np.where(obstructed, math.nan, lane["tangent"])
