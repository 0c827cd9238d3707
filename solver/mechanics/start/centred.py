"""Slides of which nothing says where they are: they begin at the points of their guides."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.start.demands import KEPT, Demands
from jointplay.solver.mechanics.start.given import Rows
from jointplay.solver.mechanics.start.levels import step_of


def centred(demands: Demands, held: AbsoluteMechanism, pose: Floats) -> Floats:
    """Return a closed pose in which slides and pins in slots are as near to the middle as they may.

    No body turns for that, and nothing that is given changes, kept or not; what joints with play
    are apart stays, too. held : whose joints hold in the pose.
    """
    still = [0.0] * len(pose)
    away, jacobian = arrays(demands.closed.slides(pose.tolist(), still), len(pose))
    if not len(away):
        return pose
    angles = demands.length * np.eye(len(pose))[2::3]
    stay = [
        demands.constraints(demands.closed, pose).jacobian,
        demands.wanted(demands.given, pose).jacobian,
        angles,
    ]
    levels = [Rows(np.zeros(len(rows)), rows) for rows in stay]
    step = step_of([*levels, Rows(away, jacobian)], demands.scale)
    if float(np.abs(step / demands.scale).max()) <= KEPT:
        return pose
    found = pose + step
    before, after = (demands.wanted(demands.given, one).value for one in (pose, found))
    changed = float(np.abs(after - before).max(initial=0.0))
    return found if demands.is_closed(held, found) and changed <= KEPT * demands.length else pose
