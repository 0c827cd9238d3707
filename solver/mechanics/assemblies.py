"""Assemblies of a mechanism: in how many ways it closes, sought from drawn start angles."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble, shortest_link
from jointplay.solver.mechanics.closing import arrays, rank
from jointplay.solver.mechanics.start.closings import alike, closings, tried
from jointplay.solver.mechanics.start.demands import Demands
from jointplay.solver.scene.document import Scene


class Assemblies(NamedTuple):
    """Assemblies that were found; of one that moves, with some coordinates held where it starts."""

    angles: list[dict[str, float]]
    """Angle of each body, rad, within half a turn; that from the scene's own start is first."""
    tried: int
    """Sets of start angles that were tried; none of a mechanism with many bodies."""
    held: list[str]
    """Coordinates that were held, for example ``crank.theta``."""
    positions: list[dict[str, tuple[float, float]]]
    """Centre of mass of each body in each of them, m."""


def assemblies(scene: Scene) -> Assemblies:
    """Seek the assemblies of a scene; there may be more than are found."""
    length = shortest_link(scene)
    demands, start = Demands.of(scene, length), assemble(scene).pose
    bodies, scale = demands.closed.bodies, demands.scale
    names = [f"{body}.{axis}" for body in bodies for axis in ("x", "y", "theta")]
    poses, held = [], np.zeros(len(start), np.bool_)
    if assemble(scene).residual <= ASSEMBLED * length:
        poses, held = [start], _held(demands.closed, start, demands.driven, scale)
    for pose in closings(demands, start, held):
        if not any(alike(pose, other, scale) for other in poses):
            poses.append(pose)
    found = [
        dict(zip(bodies, np.remainder(p[2::3] + np.pi, 2.0 * np.pi) - np.pi, strict=True))
        for p in poses
    ]
    centres = [
        dict(zip(bodies, zip(p[0::3].tolist(), p[1::3].tolist(), strict=True), strict=True))
        for p in poses
    ]
    kept = [name for name, is_held in zip(names, held, strict=True) if is_held]
    return Assemblies(found, tried(demands), kept, centres)


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
