"""The first guess of a pose: from which Newton's iteration closes the mechanism."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.products import applied, product
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, arrays
from jointplay.solver.mechanics.start.drawing import drawn_angles
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene

NOWHERE: Mapping[str, Floats] = MappingProxyType({})


def first_clocks(scene: Scene) -> dict[str, float]:
    """Return each clock at t = 0."""
    return {name: clock.start for name, clock in clocks(scene).items()}


def first_angles(scene: Scene, chosen: Mapping[str, float] | None = None) -> dict[str, float]:
    """Return angles, rad, from which the assembly starts: driven or carried, else as chosen.

    chosen : by body; None: as the scene gives and draws them.
    """
    angles = {"ground": 0.0}
    if chosen is None:
        chosen = drawn_angles(scene) | scene.start.angles
    for branch in spanning_tree(scene).branches:
        joint = scene.joints.get(branch.joint)
        offset = 0.0
        holds = joint is not None and joint.holds_angle
        if joint is not None and holds:
            offset = joint.angle
        elif branch.driver is not None:
            driver = scene.drivers[branch.driver]
            offset = driver.at(driver.clock_start).value
        carried = angles[branch.parent] + (offset if branch.outward else -offset)
        given = chosen.get(branch.body)
        if branch.turned_by is not None:
            turning = scene.drivers[branch.turned_by]
            angles[branch.body] = turning.at(turning.clock_start).value
            continue
        prescribed = branch.driver is not None and branch.freedom == "turn"
        if prescribed or given is None:
            held = prescribed or holds
            angles[branch.body] = carried if held else 0.0
        else:
            angles[branch.body] = given
    return angles


def first_pose(
    ideal: AbsoluteMechanism,
    angles: Mapping[str, float],
    driven: dict[str, float],
    centres: Mapping[str, Floats] = NOWHERE,
) -> Floats:
    """Return a pose with these angles, rad by body, in which joints are as near as they come.

    Those that need a direction count for nothing, as their points have no positions yet.
    Slides of which nothing else says where they are begin at their guides' points.
    centres : centres of mass, (2,) m by body, of those that keep theirs.
    """
    count = 3 * len(ideal.bodies)
    pose = np.zeros(count)
    positions = np.arange(count) % 3 != 2
    for i, body in enumerate(ideal.bodies):
        pose[3 * i + 2] = angles[body]
        if body in centres:
            pose[3 * i : 3 * i + 2] = centres[body]
            positions[3 * i : 3 * i + 2] = False
    rows = ideal.rows(pose.tolist(), [0.0] * count, driven)
    aimless = {name for name, joint in ideal.numbers.joints.items() if joint.needs_direction}
    residual, jacobian = arrays([row for row in rows if row.joint not in aimless], count)
    if len(residual) and positions.any():  # revolute joints are linear in x and y
        found = Decomposition(jacobian[:, positions], RANK_TOLERANCE)
        pose[positions] += found.least_squares(-residual)
        if found.rank < positions.sum():
            pose[positions] += _to_guides(ideal, pose, found, positions)
    return pose


def _to_guides(
    ideal: AbsoluteMechanism, pose: Floats, held: Decomposition, positions: Flags
) -> Floats:
    """Return how far bodies move, m, until slides that nothing holds are at their guides' points.

    `held` : of the constraints, whose columns are entries of the pose, those of `positions`.
    """
    rows, count = ideal.slides(pose.tolist(), [0.0] * len(pose)), len(pose)
    away, jacobian = arrays(rows, count)
    moved = product(jacobian[:, positions], held.free)
    moved[np.abs(moved) <= RANK_TOLERANCE] = 0.0  # rounding, where constraints hold a slide
    return applied(held.free, Decomposition(moved, RANK_TOLERANCE).least_squares(-away))
