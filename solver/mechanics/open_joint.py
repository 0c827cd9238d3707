"""The joint that stays open, where a mechanism cannot be put together."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.start.drawing import drawn_positions
from jointplay.solver.mechanics.start.guess import first_angles, first_clocks, first_pose
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene

HEAVY = 1e3
"""Weight of what stays closed against what may open; its square is the share that gives way."""
MOST_EVALUATIONS = 100


class OpenJoint(NamedTuple):
    """A joint that does not close, and by how much, in `unit` (m or rad)."""

    joint: str
    size: float
    unit: str


def open_joint(scene: Scene) -> OpenJoint:
    """Return which joint stays open most, and how far, where all joints of the tree are closed.

    The joints that may open are those that close loops, and those with play. The pose is that of
    the least squares of what stays open, near the start angles.
    """
    from scipy.optimize import least_squares  # 20 MB that only a mechanism left open needs

    ideal = AbsoluteMechanism(scene, view(scene), close_play=True)
    driven, length = first_clocks(scene), shortest_link(scene)
    angles = first_angles(scene)
    pose = first_pose(ideal, angles, driven, drawn_positions(scene, angles))
    still, count = np.zeros_like(pose), len(pose)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    tree = spanning_tree(scene)
    may_open = {*tree.closing, *tree.play}
    rows = ideal.rows(pose, still, driven)
    units = np.array([1.0 if row.part == "angle" else length for row in rows])
    weights = np.array([1.0 if row.joint in may_open else HEAVY for row in rows]) / units

    def misfit(scaled: Floats) -> Floats:
        return arrays(ideal.rows(scaled * scale, still, driven), count)[0] * weights

    def slope(scaled: Floats) -> Floats:
        jacobian = arrays(ideal.rows(scaled * scale, still, driven), count)[1]
        return jacobian * scale * weights[:, None]

    nearest = least_squares(misfit, pose / scale, jac=slope, max_nfev=MOST_EVALUATIONS)
    left = np.abs(nearest.fun / weights)
    widest = int(np.argmax(left / units))
    joint = rows[widest].joint
    if rows[widest].part == "angle":
        return OpenJoint(joint, float(left[widest]), "rad")
    along = [i for i, row in enumerate(rows) if row.joint == joint and row.part != "angle"]
    return OpenJoint(joint, float(np.linalg.norm(left[along])), "m")
