"""Rate at which the fastest part of a lane's motion dies or swings: it limits an explicit step."""

import numpy as np

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import aligned_zeros
from jointplay.solver.linear_algebra.spectral_radius import spectral_radius

SQUARINGS = 10
"""Squarings of a Jacobian whose eigenvectors' condition may be 1e6: the rate is known to 1.5 %."""

COARSEST = 256.0
"""Roundings of a state that a step has at least: its slopes' differences are known to 0.4 %."""


def fastest_rate(bundle: Bundle, i: int) -> float:
    """Return the largest magnitude of an eigenvalue of the Jacobian at a lane's state, 1/s.

    The slopes are differentiated by steps of the error that a state may have, or of `COARSEST`
    roundings where that is less: of small clearances at tight tolerances. 0: not known.
    """
    lane, kernel, lanes = bundle.lane(i), bundle.kernel, bundle.width
    size = kernel.layout.size
    work = aligned_zeros(size, lanes)
    work[:] = lane.work[:size, lane.index, None]
    stage, slope = kernel.layout.block("stage"), kernel.layout.block("slope")
    y = lane["y"].copy()
    moves = np.maximum(1.0 / lane["weight"], COARSEST * np.spacing(np.abs(y)))
    states = len(y)
    work[kernel.layout["stage_time"]] = lane.number("time")
    jacobian = np.empty((states, states))
    work[stage] = y[:, None]
    kernel.module.right_hand_side(work)
    still = work[slope][:, :1].copy()
    for first in range(0, states, lanes):
        chosen = np.arange(first, min(first + lanes, states))
        columns = np.arange(len(chosen))
        work[stage] = y[:, None]
        work[stage.start + chosen, columns] += moves[chosen]
        moved = work[stage.start + chosen, columns] - y[chosen]
        kernel.module.right_hand_side(work)
        jacobian[:, chosen] = (work[slope][:, columns] - still) / moved
    if not np.isfinite(jacobian).all():
        return 0.0
    return spectral_radius(jacobian, SQUARINGS)
