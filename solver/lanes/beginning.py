"""Evaluates a lane's start: first slopes, contacts that begin closed, first extremes, tangent."""

import math

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.kernels.emit.knots import AT_ENDS
from jointplay.solver.kernels.emit.stepping import ENDS
from jointplay.solver.kernels.loop.entry_points import start_tangents
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.impact_floors import resting_rate
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

CLOSING_STEPS = 8
"""Newton steps that close the loops of a given start."""


def begin(lanes: Lane, start: LaneStart | None, resting: Floats, obstructed: Flags) -> None:
    """Evaluate the start of all lanes of a work array, which is their own or the scene's.

    Parameters
    ----------
    resting : (pairs, lanes)
        As `resting_rates` returns them, m/s.
    obstructed : (lanes,)
        Where no tangent can follow the motion.
    """
    module = lanes.kernel.module
    lanes["stage"] = lanes["y"]
    if start is not None and not start.closed and lanes.kernel.equations.loops is not None:
        for _ in range(CLOSING_STEPS):
            module.project(lanes.work)
        lanes["y"] = lanes["stage"]
    floor = lanes["impact_floor"]
    lanes["mode"], lanes["impact_rate"] = 0.0, floor
    module.right_hand_side(lanes.work)
    rate, closed = lanes["penetration_rate"], lanes["penetration"] > 0.0
    latched: Floats = np.maximum(rate, resting)
    if start is not None and start.contact is not None and start.impact_rate is not None:
        latched = np.where(start.contact, start.impact_rate, rate.T).T
    lanes["mode"], lanes["impact_rate"] = 1.0 * closed, np.maximum(latched, floor)
    lanes["approach_rate"] = rate
    lanes["onset_time"] = lanes["onset_total"] = 0.0
    lanes["opened"] = math.inf
    module.right_hand_side(lanes.work)
    lanes["k1_"], lanes["kledger1_"] = lanes["slope"], lanes["ledger"]
    lanes["total"] = 0.0
    module.weigh(lanes.work)
    for quantity in ("potential", "stored", "eccentricity", *ENDS, *AT_ENDS):
        lanes[f"{quantity}_start"] = lanes[quantity]
    lanes["resumed"] = lanes["gross"] = 0.0
    module.observe(lanes.work)
    rows = lanes.kernel.rows.scanned
    for kind in ("previous", "highest", "lowest"):
        lanes[kind] = lanes["channel"][:rows]
    lanes["highest_time"] = lanes["lowest_time"] = lanes["rounding"] = 0.0
    lanes["change"] = math.nan
    # largest forces of contacts are as they are foretold, but where a force jumps to its largest
    lanes["lowest"][rows - len(floor) :] = np.where(lanes["abrupt"] > 0.0, 0.0, -math.inf)
    if lanes.tangents is not None:
        _start_tangents(lanes, obstructed)


def resting_rates(scene: Scene) -> Floats:
    """Return the least impact rate of each pair that touches from the start on, m/s.

    (pairs,), or (pairs, points) if the scene has the numbers of many points.
    """
    length = shortest_link(scene)
    pairs = contact_pairs(scene).values()
    rates = [resting_rate(scene, pair, length) for pair in pairs]
    return np.array(np.broadcast_arrays(*rates), np.float64) if rates else np.zeros(0)


def _start_tangents(lanes: Lane, obstructed: Flags) -> None:
    """Give lanes their first tangents; their states are in the stages still.

    Where a law jumps there is none: the tangent is NaN, and so is its growth.
    """
    assert lanes.tangents is not None  # noqa: S101  (asked before)
    start_tangents(lanes.slots, lanes.work)
    lanes.tangents.module.kinks(lanes.work)
    lanes["kink_start"] = lanes["kink_end"]
    if lanes.kernel.equations.loops is not None:
        lanes["accept"] = 1.0
        lanes.tangents.module.hold_tangent(lanes.work)
        lanes["accept"] = 0.0
    lanes["tangent"] = np.where(obstructed, math.nan, lanes["tangent"])
