"""Evaluates a lane's start: first slopes, contacts that begin closed, first records, tangent."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.kernel import LOSSES
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.problem import LaneProblem
from jointplay.solver.kernels.loop.tangent import start_tangent
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import tangent_obstacle

if TYPE_CHECKING:
    from jointplay.solver.kernels.loop.bundle import Bundle

Floats = NDArray[np.float64]


def begin(bundle: Bundle, lane: int, problem: LaneProblem) -> None:
    """Evaluate a lane's start: first slopes, contacts that begin closed, first records."""
    start = problem.start
    kernel, module = bundle.kernel, bundle.kernel.module
    joints, rows = len(kernel.play), kernel.rows.scanned
    lanes = bundle.work.reshape(-1, LANES)[:, lane]
    at = kernel.layout

    def block(name: str, count: int) -> Floats:
        return lanes[at[name] : at[name] + count]

    block("stage0", kernel.states)[:] = block("y0", kernel.states)
    floor = block("impact_floor0", joints) if joints else np.zeros(0)
    for j in range(joints):
        lanes[at[f"mode{j}"]], lanes[at[f"impact_rate{j}"]] = 0.0, floor[j]
    module.right_hand_side(bundle.work)
    for j in range(joints):
        rate = lanes[at[f"gap_rate{j}"]]
        closed = lanes[at[f"gap{j}"]] > 0.0
        latched = max(rate, floor[j])
        if start is not None and start.contact is not None and start.contact[j]:
            latched = max(start.impact_rate[j], floor[j])  # type: ignore[index]
        lanes[at[f"mode{j}"]] = 1.0 if closed else 0.0
        lanes[at[f"impact_rate{j}"]] = latched
        lanes[at[f"approach{j}"]] = rate
        lanes[at[f"onset_time{j}"]] = lanes[at[f"onset_total{j}"]] = 0.0
    module.right_hand_side(bundle.work)
    ledger = LOSSES + len(kernel.drivers) + joints
    block("k1_0", kernel.states)[:] = block("slope0", kernel.states)
    block("kledger1_0", ledger)[:] = block("ledger0", ledger)
    block("total0", ledger)[:] = 0.0
    module.weigh(bundle.work)
    for energy in ("potential", "stored"):
        lanes[at[f"{energy}_start"]] = lanes[at[energy]]
    lanes[at["gross"]] = 0.0
    for j in range(joints):
        lanes[at[f"gap_start{j}"]] = lanes[at[f"gap{j}"]]
        lanes[at[f"gap_rate_start{j}"]] = lanes[at[f"gap_rate{j}"]]
    module.observe(bundle.work)
    for name in ("previous0", "highest0", "lowest0"):
        block(name, rows)[:] = block("channel0", rows)
    for name in ("highest_time0", "lowest_time0"):
        block(name, rows)[:] = 0.0
    block("change0", rows)[:] = math.nan
    if joints:
        block("lowest0", rows)[rows - joints :] = -math.inf
    if bundle.tangents is not None:
        _start_tangent(bundle, lane, problem.scene)


def _start_tangent(bundle: Bundle, lane: int, scene: Scene) -> None:
    """Give a lane its first tangent; its state is in the stage still.

    Where a law jumps there is none: the tangent is NaN, and so is its growth.
    """
    assert bundle.tangents is not None  # noqa: S101  (asked before)
    start_tangent(lane, bundle.slots, bundle.work)
    if bundle.tangents.kinks:
        bundle.tangents.module.kinks(bundle.work)
        rows = 3 * bundle.tangents.kinks
        bundle.table("kink_start0", rows)[:, lane] = bundle.table("kink_end0", rows)[:, lane]
    if tangent_obstacle(scene):
        bundle.table("tangent0", bundle.kernel.states)[:, lane] = math.nan
