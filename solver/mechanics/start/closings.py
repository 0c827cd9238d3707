"""Closed poses of a mechanism, sought from drawn start angles; there may be more than are found."""

from collections.abc import Iterator

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.joints.joint import Joint
from jointplay.solver.mechanics.closing import NEAR, close, close_many
from jointplay.solver.mechanics.start.demands import Demands
from jointplay.solver.mechanics.start.guess import first_angles, first_pose

DRAWN, SEED = 24, 11
"""Sets of start angles that are tried, and how they are drawn: the same each time."""
MOST_BODIES = 16
"""Bodies up to which closed poses are sought, within seconds; of more the time would be felt."""
MOST_ITERATIONS = 40
MOST_FACING = 32
"""Poses of which each roller is moved to the other side of its cam."""
ALIKE = 1e-6
"""Distance of poses, in rad and lengths of the shortest link, below which they are one."""


def tried(demands: Demands) -> int:
    """Return how many sets of start angles are tried; none of a mechanism with many bodies."""
    return DRAWN if len(demands.closed.bodies) <= MOST_BODIES else 0


def closings(
    demands: Demands, start: Floats | None = None, held: Flags | None = None
) -> Iterator[Floats]:
    """Yield closed poses, each once; coordinates that are `held` are those of a start."""
    bodies, found = demands.closed.bodies, list[Floats]()
    draws = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (tried(demands), len(bodies)))
    if not len(draws):
        return
    kept = np.zeros(len(demands.scale), np.bool_) if held is None else held
    poses = np.array([_drawn(demands, deviates) for deviates in draws])
    if start is not None:
        poses[:, kept] = start[kept]
    close_many(demands.closed, poses, demands.driven, demands.scale, kept, MOST_ITERATIONS)

    def fresh(pose: Floats) -> bool:
        """Tell whether a pose closes, and as no other does."""
        close(demands.closed, pose, demands.driven, demands.scale, kept, MOST_ITERATIONS)
        known = any(alike(pose, other, demands.scale) for other in found)
        return not known and demands.is_closed(demands.closed, pose)

    for pose in poses:
        if any(alike(pose, other, demands.scale, NEAR) for other in found):
            continue
        if fresh(pose):
            found.append(pose)
            yield pose
    for joint in _facing(demands):
        for pose in tuple(found)[:MOST_FACING]:
            other = _across(demands, joint, pose, kept)
            if fresh(other):
                found.append(other)
                yield other


def _facing(demands: Demands) -> list[Joint]:
    """Return the joints that hold a body apart from another, on one side of it or the other."""
    bodies = demands.closed.bodies
    joints = demands.scene.joints.values()
    return [one for one in joints if one.needs_direction and one.bodies[1] in bodies]


def _across(demands: Demands, joint: Joint, pose: Floats, kept: Flags) -> Floats:
    """Return a pose with a joint's second body moved to the other side of the first.

    Drawn angles do not bring a roller that slides to the other side of its cam.
    """
    moved, first = pose.copy(), 3 * demands.closed.bodies.index(joint.bodies[1])
    gap = demands.closed.ends(joint.points, pose, np.zeros_like(pose)).gap
    moved[first : first + 2] -= 2.0 * np.array(gap)
    return np.where(kept, pose, moved)


def _drawn(demands: Demands, deviates: Floats) -> Floats:
    """Return a pose with drawn angles, joints as near as they come."""
    chosen = dict(zip(demands.closed.bodies, deviates.tolist(), strict=True))
    return first_pose(demands.closed, first_angles(demands.scene, chosen), demands.driven)


def alike(pose: Floats, other: Floats, scale: Floats, within: float = ALIKE) -> bool:
    """Return whether two poses are one, but for whole turns of bodies."""
    apart = (pose - other) / scale
    apart[2::3] = np.remainder(apart[2::3] + np.pi, 2.0 * np.pi) - np.pi
    return float(np.abs(apart).max(initial=0.0)) <= within
