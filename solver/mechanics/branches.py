"""Assemblies of a mechanism: in how many ways it closes, sought from drawn start angles."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import (
    ASSEMBLED,
    assemble,
    first_angles,
    first_clocks,
    first_pose,
    shortest_link,
)
from jointplay.solver.mechanics.closing import arrays, close, rank
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene

DRAWN, SEED = 24, 11
"""Sets of start angles that are tried, and how they are drawn: the same each time."""
MOST_BODIES = 8
"""Bodies up to which assemblies are sought; of more the time would be felt."""
MOST_ITERATIONS = 40
ALIKE = 1e-6
"""Distance of poses, in rad and lengths of the shortest link, below which they are one."""


class Branches(NamedTuple):
    """Assemblies that were found; of one that moves, with some coordinates held where it starts."""

    angles: list[dict[str, float]]
    """Angle of each body, rad, within half a turn; that from the scene's own start is first."""
    tried: int
    """Sets of start angles that were tried; none of a mechanism with many bodies."""
    held: list[str]
    """Coordinates that were held, for example ``crank.theta``."""
    places: list[dict[str, tuple[float, float]]]
    """Centre of mass of each body in each of them, m."""


def branches(scene: Scene) -> Branches:
    """Seek the assemblies of a scene; there may be more than are found."""
    ideal = AbsoluteMechanism(scene, view(scene), close_play=True)
    driven, length = first_clocks(scene), shortest_link(scene)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    start = assemble(scene).pose
    names = [f"{body}.{axis}" for body in ideal.bodies for axis in ("x", "y", "theta")]
    poses, held = [], np.zeros(len(start), np.bool_)
    if assemble(scene).residual <= ASSEMBLED * length:
        poses, held = [start], _held(ideal, start, driven, scale)
    tried = DRAWN if len(ideal.bodies) <= MOST_BODIES else 0
    for deviates in np.random.default_rng(SEED).uniform(-np.pi, np.pi, (tried, len(scene.bodies))):
        angles = first_angles(scene) | dict(zip(ideal.bodies, deviates.tolist(), strict=True))
        pose = first_pose(ideal, angles, driven)
        pose[held] = start[held]
        close(ideal, pose, driven, scale, held, MOST_ITERATIONS)
        residual, _ = arrays(ideal.rows(pose, np.zeros_like(pose), driven), len(pose))
        closed = np.abs(residual).max(initial=0.0) <= ASSEMBLED * length
        if closed and not any(_alike(pose, other, scale) for other in poses):
            poses.append(pose)
    found = [
        dict(zip(ideal.bodies, np.remainder(p[2::3] + np.pi, 2.0 * np.pi) - np.pi, strict=True))
        for p in poses
    ]
    places = [
        dict(zip(ideal.bodies, zip(p[0::3].tolist(), p[1::3].tolist(), strict=True), strict=True))
        for p in poses
    ]
    kept = [name for name, is_held in zip(names, held, strict=True) if is_held]
    return Branches(found, tried, kept, places)


def _held(ideal: AbsoluteMechanism, pose: Floats, driven: dict[str, float], scale: Floats) -> Flags:
    """Return which coordinates, angles first, leave no freedom if they are held; (3 bodies,)."""
    _, jacobian = arrays(ideal.rows(pose, np.zeros_like(pose), driven), len(pose))
    rows = jacobian * scale
    held = np.zeros(len(pose), np.bool_)
    count = rank(rows)
    for k in sorted(range(len(pose)), key=lambda k: (k % 3 != 2, k)):
        more = np.vstack([rows, np.eye(len(pose))[k]])
        if count < len(pose) and rank(more) > count:
            rows, held[k], count = more, True, count + 1
    return held


def _alike(pose: Floats, other: Floats, scale: Floats) -> bool:
    apart = (pose - other) / scale
    apart[2::3] = np.remainder(apart[2::3] + np.pi, 2.0 * np.pi) - np.pi
    return float(np.abs(apart).max()) <= ALIKE
