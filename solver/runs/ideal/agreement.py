"""Whether drivers agree with what ideal joints and other drivers hold already."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.closing import arrays, rank
from jointplay.solver.mechanics.start.guess import first_clocks
from jointplay.solver.mechanics.view import view
from jointplay.solver.runs.ideal.constraints import Constraints
from jointplay.solver.runs.ideal.path import Path
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers_time import drivers_time
from jointplay.solver.scene.time_scales import quickest_driver

MOST_WORK = 40_000
"""Coordinates of all poses after which a check leaves off: seconds."""


def drivers_agree(scene: Scene) -> bool:
    """Return whether no driver works against ideal joints or other drivers; play is let go.

    Where one prescribes what is held already, the drivers are followed until all are back, or have
    shown their motion. What none of them moves is carried along, as little as the joints need.
    """
    length = shortest_link(scene)
    shown = drivers_time(scene, length)
    if shown is None or not _held_twice(scene, length):  # None: the drivers stand
        return True
    pose, constraints = assemble(scene).pose, Constraints(scene, close_play=False)
    path = Path(constraints, pose, min(quickest_driver(scene, length), shown.seconds))
    path.follow(shown.seconds, MOST_WORK // max(len(pose), 20))
    return path.end.consistent


def _held_twice(scene: Scene, length: float) -> bool:
    """Tell whether a driver prescribes at the start what something else holds."""
    whole, undriven = (_jacobian(scene, length, driven=driven) for driven in (True, False))
    return rank(whole) < rank(undriven) + len(whole) - len(undriven)


def _jacobian(scene: Scene, length: float, *, driven: bool) -> Floats:
    """Return the Jacobian (rows, 3 bodies) at the start, in lengths, m, and rad."""
    mechanism = AbsoluteMechanism(scene, view(scene), close_play=False, driven=driven)
    pose = assemble(scene).pose
    rows = mechanism.rows(pose.tolist(), [0.0] * len(pose), first_clocks(scene))
    scale = np.tile([length, length, 1.0], len(scene.bodies))
    jacobian: Floats = arrays(rows, len(pose))[1] * scale
    return jacobian
