"""Bodies as drawn: the angles and positions that `start.points` gives them, as a first guess.

Two points or more of a body give it an angle, by the least squares of their distances from where
they are drawn; one gives it a position only.
"""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import product
from jointplay.solver.quantities.scalars import direction_angle, sine_cosine
from jointplay.solver.scene.document import Scene


def drawn_angles(scene: Scene) -> dict[str, float]:
    """Return the angles of bodies of which two points or more are drawn apart, rad."""
    found: dict[str, float] = {}
    for body, (own, there) in _drawn(scene).items():
        (x, y), (u, v) = (own - own.mean(axis=0)).T, (there - there.mean(axis=0)).T
        along, across = float((x * u + y * v).sum()), float((x * v - y * u).sum())
        if len(own) > 1 and (along != 0.0 or across != 0.0):
            found[body] = float(direction_angle(along, across))
    return found


def drawn_positions(scene: Scene, angles: dict[str, float]) -> dict[str, Floats]:
    """Return centres of mass of drawn bodies, (2,) m, once their angles, rad, are known."""
    found: dict[str, Floats] = {}
    for body, (own, there) in _drawn(scene).items():
        s, c = sine_cosine(angles[body])
        found[body] = (there - product(own, np.array([[c, s], [-s, c]]))).mean(axis=0)
    return found


def _drawn(scene: Scene) -> dict[str, tuple[Floats, Floats]]:
    """Return points of each drawn body, (points, 2) m, in its own axes and in the world's."""
    positions: dict[str, list[tuple[list[float], list[float]]]] = {}
    for reference, position in scene.start.points.items():
        body, point = reference.split(".")
        positions.setdefault(body, []).append((scene.bodies[body].points[point], position))
    return {
        body: (np.array([own for own, _ in pairs]), np.array([there for _, there in pairs]))
        for body, pairs in positions.items()
    }
