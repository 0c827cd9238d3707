"""Dragging: a point of the ideal mechanism pulled to a position, as far as the joints let it.

Levenberg's and Marquardt's iteration on the distance (Levenberg 1944, Marquardt 1963), along the
directions in which the constraints let the mechanism move; after each step it is closed again.
"""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import ASSEMBLED, shortest_link
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, arrays, close, part_taken
from jointplay.solver.mechanics.start.guess import first_clocks
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene

MOST_STEPS = 24
ITERATIONS, CONVERGED = 12, 1e-7
"""Steps of Newton's iteration, and the last one, which leaves an error of its square."""
GENTLE, GENTLEST = 1e-3, 1e9
"""Damping of the first step, and that at which nothing comes nearer; in squared lengths."""
NEAR, NEARER = 1e-9, 1e-6
"""Lengths, and share of a distance below one, by which a step comes nearer, or is the last."""


def drag(scene: Scene, pose: Floats, point: str, position: tuple[float, float]) -> Floats:
    """Return the pose in which a point is as near to a position as it comes from a pose.

    Drivers let go, clearances are closed. pose : (3 bodies,) x, y (m), theta (rad), near which the
    mechanism is closed first. point : ``body.point``. position : x, y in m.
    """
    return _Dragging(scene, point, position).dragged(pose)


class _Dragging:
    def __init__(self, scene: Scene, point: str, position: tuple[float, float]) -> None:
        self.mechanism = AbsoluteMechanism(scene, view(scene), close_play=True, driven=False)
        self.clocks = first_clocks(scene)
        self.length = shortest_link(scene)
        self.scale = np.tile([self.length, self.length, 1.0], len(scene.bodies))
        self.still = np.zeros(len(self.scale))
        self.point, self.position = point, np.array(position)

    def dragged(self, pose: Floats) -> Floats:
        """Return the pose nearest to the position; see `drag`."""
        here = pose.copy()
        jacobian, _ = self._close(here)
        damping = GENTLE * self.length**2
        free, slopes = self._free(here, jacobian)
        gap = self._gap(here)
        for _ in range(MOST_STEPS):
            if not len(free) or damping > GENTLEST * self.length**2:
                break
            normal = slopes.T @ slopes + damping * np.eye(len(free))
            step = np.linalg.solve(normal, slopes.T @ gap) @ free
            there = here + self.scale * step * part_taken(step)
            jacobian, closed = self._close(there)
            left = self._gap(there)
            far, near = float(np.linalg.norm(gap)), float(np.linalg.norm(left))
            if not closed or near >= far:
                damping *= 10.0
                continue
            here, gap, damping = there, left, damping * 0.2
            if far - near < NEAR * self.length + NEARER * min(near, self.length):
                break
            free, slopes = self._free(here, jacobian)
        return here

    def _close(self, pose: Floats) -> tuple[Floats, bool]:
        """Move a pose to where the joints close. Returns their Jacobian, and whether they do."""
        close(self.mechanism, pose, self.clocks, self.scale, None, ITERATIONS, CONVERGED)
        rows = self.mechanism.rows(pose, self.still, self.clocks)
        residual, jacobian = arrays(rows, len(pose))
        off = float(np.abs(residual).max(initial=0.0))
        return jacobian, off <= ASSEMBLED * max(1.0, self.length)

    def _gap(self, pose: Floats) -> Floats:
        x, y = self.mechanism.marker(self.point, pose, self.still).position
        return np.asarray(self.position - (x, y), np.float64)

    def _free(self, pose: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """Return directions that the joints leave, (freedom, 3 bodies), and what they move.

        What they move: the point, (2, freedom) m.
        """
        free = np.eye(len(pose))
        if len(jacobian):
            _, values, directions = np.linalg.svd(jacobian * self.scale)
            free = directions[int((values > RANK_TOLERANCE * values[0]).sum()) :]
        marker = self.mechanism.marker(self.point, pose, self.still)
        slopes = np.zeros((2, len(pose)))
        at = 3 * marker.body
        slopes[0, at], slopes[1, at + 1] = 1.0, 1.0
        slopes[:, at + 2] = -marker.arm[1], marker.arm[0]
        return free, slopes * self.scale @ free.T
