"""The way to what is out of reach: along closed poses, to where none is nearer.

There a body stands at a dead point: it moves with the square of what the others move by. Newton's
iteration leaves the closed poses on its way, for what is given draws it off them.
"""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.closing import LARGEST_TURN, close
from jointplay.solver.mechanics.start.demands import Demands
from jointplay.solver.mechanics.start.given import distance
from jointplay.solver.mechanics.start.levels import step_of

HALVINGS = 40
"""Times that a step is halved at most, until it brings what is given nearer."""
SMALL = 1e-6
"""Step, in rad and links, from which on a pose is taken to be the nearest: at a dead point all
are large."""
CLOSING = 20
"""Iterations after which a pose that has not closed is too far away."""


def as_near_as_it_gets(demands: Demands, pose: Floats, iterations: int) -> Floats:
    """Return the closed pose, (3 bodies,), to which steps from a closed one lead.

    Each is closed again before it is judged, and halved until it brings what is given nearer. The
    next one is at most twice as long.
    """
    still, reach = np.zeros_like(pose), LARGEST_TURN
    least = distance(demands.given, pose, still)
    for _ in range(iterations):
        step = step_of(
            [demands.constraints(demands.closed, pose), demands.wanted(demands.given, pose)],
            demands.scale,
        )
        size = float(np.abs(step / demands.scale).max())
        if size < SMALL:
            break
        step *= min(1.0, reach / size)
        for _ in range(HALVINGS):
            moved = pose + step
            close(demands.closed, moved, demands.driven, demands.scale, iterations=CLOSING)
            apart = distance(demands.given, moved, still)
            if apart < least and demands.is_closed(demands.closed, moved):
                break
            step = 0.5 * step
        else:
            break
        pose, least, reach = moved, apart, 2.0 * float(np.abs(step / demands.scale).max())
    return pose
