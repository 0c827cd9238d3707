"""Following the ideal mechanism: its poses as the drivers go on, and where they cannot.

What no driver moves is carried along, as little as the joints need.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import LimitExceeded, SimulationFailed
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble_closed
from jointplay.solver.runs.ideal.constraints import Constraints
from jointplay.solver.runs.ideal.dead_point import lost_at
from jointplay.solver.runs.ideal.path import FEWEST_A_SCALE, Path
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.time_scales import quickest_driver

MOST_POSES = 4096
"""Poses of a path: seconds."""
MOST_IN_VAIN = 768
"""Poses of a path to an instant out of reach: only for where it may jam before."""


@dataclass(frozen=True)
class Followed:
    """Poses of an ideal mechanism at instants, up to where it is lost."""

    poses: Floats
    """(instants that are reached, 3 bodies) x, y (m) and theta (rad), whole turns counted."""
    lost: SimulationFailed | None
    """Where drivers cannot go on: at a dead point, or where the links do not reach."""


def follow(scene: Scene, times: Sequence[float]) -> Followed:
    """Return the poses of a scene, its clearances closed, at instants.

    times : s, from 0 on, none before the one before it.

    Raises
    ------
    LimitExceeded
        The last instant is too many turns of a driver away.
    """
    start, constraints = assemble_closed(scene), Constraints(scene)
    instants = np.array(times, np.float64)
    if start.residual > ASSEMBLED * constraints.length:
        miss = f"The joints do not close at t = 0: {start.residual:.3g} (m or rad) remain."
        first = np.tile(start.pose, (int((instants <= 0.0).sum()), 1))
        return Followed(first, SimulationFailed("assembly-lost", miss, 0.0))
    scale = quickest_driver(scene, constraints.length)
    if math.isinf(scale):  # nothing is driven
        return Followed(np.tile(start.pose, (len(instants), 1)), None)
    path, last = Path(constraints, start.pose, scale), float(instants[-1])
    farthest = MOST_POSES * scale / FEWEST_A_SCALE
    most = MOST_POSES if last <= farthest else MOST_IN_VAIN
    whole = path.follow(last, most)
    reached = path.end.time
    if not whole and len(path.times) >= most:
        farthest = reached if most == MOST_POSES else farthest
        raise LimitExceeded.at(
            "/times",
            f"The mechanism is followed through {MOST_POSES} poses, to {farthest:.3g} s at most;"
            " give earlier times.",
        )
    lost = None if whole else _ended(scene, instants) or lost_at(path, scene)
    poses = path.poses(instants[instants <= reached])
    poses[instants[: len(poses)] == 0.0] = start.pose
    return Followed(poses, lost)


def _ended(scene: Scene, instants: Floats) -> SimulationFailed | None:
    """Return that the motion of a driver is given up to before the last instant, if one is."""
    for name, driver in scene.drivers.items():
        domain = driver.motion.domain if isinstance(driver, MovingDriver) else None
        if domain is not None and instants[-1] > domain[1]:
            miss = f"The motion of driver '{name}' is given up to t = {domain[1]:.4g} s."
            return SimulationFailed("assembly-lost", miss, float(domain[1]))
    return None
