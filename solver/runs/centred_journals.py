"""Journals so close to the centre of their bearing that rounding of positions turns their normal.

Bristles bend with the slip along the tangent, apart from the wall, too. Beside the centre that
direction is a difference of two positions, known to their rounding alone, and where the world's
origin is far away no step may be short enough.
"""

import math

import numpy as np

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.references import inner_states

KNOWN = 1e-6
"""Error of a direction, rad, above which bristles may not be followed."""


def centred_journal(bundle: Bundle, lane: int, scene: Scene) -> str:
    """Say which journal with bristles a lane stopped at for that, and what helps; empty: none."""
    bristled = [name for name in inner_states(scene) if contact_pairs(scene)[name].is_journal]
    if not bristled:
        return ""
    rows = bundle.kernel.rows
    names = [f"{body}.{axis}" for body in scene.bodies for axis in "xy"]
    names += [f"{name}.eccentricity_{axis}" for name in bristled for axis in "xy"]
    columns = np.array([rows.index(name) for name in names], np.int64)
    found = bundle.observe(lane, bundle.lane(lane).row(), columns)[0].reshape(-1, 2)
    positions, eccentricities = found[: len(scene.bodies)], found[len(scene.bodies) :]
    away = max(np.hypot(*positions.T).max(), *(math.hypot(*at) for at in _ground(scene)))
    least = np.finfo(float).eps * away / KNOWN
    for name, (x, y) in zip(bristled, eccentricities, strict=True):
        distance = math.hypot(x, y)
        if distance < min(least, contact_pairs(scene)[name].play):
            enough = 10.0 ** math.ceil(math.log10(least))
            return (
                f"the journal of '{name}' is {distance:.2g} m from the centre of its bearing, and"
                f" {away:.3g} m from the world's origin, so that rounding of positions turns the"
                f" direction in which its bristles bend. Start it off the centre, with an"
                f" eccentricity of {enough:g} m or more, lay the origin beside the bearing, or"
                " choose a friction law without bristles"
            )
    return ""


def _ground(scene: Scene) -> list[tuple[float, float]]:
    """Return the positions of points of the ground, m, and the origin."""
    return [(0.0, 0.0), *((float(x), float(y)) for x, y in scene.ground.points.values())]
