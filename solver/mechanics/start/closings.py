"""Closed poses of a mechanism, sought from drawn start angles; there may be more than are found."""

from collections.abc import Iterator

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.mechanics.closing import NEAR, close, close_many
from jointplay.solver.mechanics.start.guess import first_angles, first_pose
from jointplay.solver.mechanics.start.pose import Places

DRAWN, SEED = 24, 11
"""Sets of start angles that are tried, and how they are drawn: the same each time."""
MOST_BODIES = 16
"""Bodies up to which closed poses are sought, within seconds; of more the time would be felt."""
MOST_ITERATIONS = 40
ALIKE = 1e-6
"""Distance of poses, in rad and lengths of the shortest link, below which they are one."""


def tried(places: Places) -> int:
    """Return how many sets of start angles are tried; none of a mechanism with many bodies."""
    return DRAWN if len(places.closed.bodies) <= MOST_BODIES else 0


def closings(
    places: Places, start: Floats | None = None, held: Flags | None = None
) -> Iterator[Floats]:
    """Yield closed poses, each once; coordinates that are `held` are those of a start."""
    bodies, found = places.closed.bodies, list[Floats]()
    draws = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (tried(places), len(bodies)))
    if not len(draws):
        return
    kept = np.zeros(len(places.scale), np.bool_) if held is None else held
    poses = np.array([_drawn(places, deviates) for deviates in draws])
    if start is not None:
        poses[:, kept] = start[kept]
    close_many(places.closed, poses, places.driven, places.scale, kept, MOST_ITERATIONS)
    for pose in poses:
        if any(alike(pose, other, places.scale, NEAR) for other in found):
            continue
        close(places.closed, pose, places.driven, places.scale, kept, MOST_ITERATIONS)
        fresh = not any(alike(pose, other, places.scale) for other in found)
        if fresh and places.is_closed(places.closed, pose):
            found.append(pose)
            yield pose


def _drawn(places: Places, deviates: Floats) -> Floats:
    """Return a pose with drawn angles, joints as near as they come."""
    chosen = dict(zip(places.closed.bodies, deviates.tolist(), strict=True))
    return first_pose(places.closed, first_angles(places.scene, chosen), places.driven)


def alike(pose: Floats, other: Floats, scale: Floats, within: float = ALIKE) -> bool:
    """Return whether two poses are one, but for whole turns of bodies."""
    apart = (pose - other) / scale
    apart[2::3] = np.remainder(apart[2::3] + np.pi, 2.0 * np.pi) - np.pi
    return float(np.abs(apart).max(initial=0.0)) <= within
