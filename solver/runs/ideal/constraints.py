"""Constraints of an ideal mechanism as arrays without units, at one instant or at many."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.elimination import solve as solve_square
from jointplay.solver.linear_algebra.many import least_squares, smallest
from jointplay.solver.linear_algebra.products import applied
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.closing import RANK_TOLERANCE
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene


class System(NamedTuple):
    """Constraint rows in arrays, (..., rows) and (..., rows, 3 bodies), in lengths and rad."""

    rows: list[Row]
    value: Floats
    jacobian: Floats
    rate: Floats
    """dΦ/dt, 1/s."""
    gamma: Floats
    """Value that Φ_q q̈ must have, 1/s^2."""


class Constraints:
    """The rows of a scene, by default with its play closed; lengths are in its shortest link.

    `scale` : (3 bodies,) what coordinates are measured in, m and rad. `free` : whether something
    moves that drivers do not.
    """

    def __init__(self, scene: Scene, *, close_play: bool = True) -> None:
        self.numbers, start = view(scene), assemble(scene)
        self.mechanism = AbsoluteMechanism(scene, self.numbers, close_play=close_play)
        self.length = shortest_link(scene)
        self.free = (start.freedom if close_play else start.freedom_with_play) > 0
        self.scale = np.tile([self.length, self.length, 1.0], len(self.mechanism.bodies))
        self._clocks = clocks(scene)

    @property
    def lengths(self) -> list[str]:
        """Return the joint of each row that holds a length; empty names for rows of angles."""
        still = np.zeros_like(self.scale)
        rows = self.system(still, still, self.driven(0.0)).rows
        return ["" if row.part == "angle" else row.joint for row in rows]

    def driven(self, time: float | Floats) -> dict[str, float | Floats]:
        """Return each clock at instants in s."""
        return {name: clock.start + clock.rate * time for name, clock in self._clocks.items()}

    def system(self, q: Floats, v: Floats, driven: dict[str, float | Floats]) -> System:
        """Return the rows at poses (..., 3 bodies) in m and rad, with their rates."""
        one = q.ndim == 1  # then floats, which take a third of the time
        rows = self.mechanism.rows(
            q.tolist() if one else list(q.T), v.tolist() if one else list(v.T), driven
        )
        lead = q.shape[:-1]
        jacobian = np.zeros((*lead, len(rows), len(self.scale)))
        value, rate, gamma = (np.empty((*lead, len(rows))) for _ in range(3))
        units = self.units(rows)
        for i, row in enumerate(rows):
            for k, entry in row.jacobian.items():
                jacobian[..., i, k] = entry
            value[..., i], rate[..., i], gamma[..., i] = row.value, row.rate, row.gamma
        jacobian *= self.scale / units[:, None]
        return System(rows, value / units, jacobian, rate / units, gamma / units)

    def units(self, rows: list[Row]) -> Floats:
        """Return what each row is measured in, m or rad."""
        return np.array([1.0 if row.part == "angle" else self.length for row in rows])


def solve(matrix: Floats, right: Floats, *, free: bool = False) -> Floats:
    """Return x of A x = b, (..., n); of more rows than columns, those of least squares.

    A : (..., rows, n) of rank n; LinAlgError if it is singular. Where it is `free`, of any rank:
    the smallest x. b : (..., rows).
    """
    if free:
        inverse = np.asarray(np.linalg.pinv(matrix, rcond=RANK_TOLERANCE), np.float64)
        return applied(inverse, right)  # shown, not stored
    if matrix.shape[-2] == matrix.shape[-1]:
        return solve_square(matrix, right)
    return least_squares(matrix, right)


def solve_transposed(matrix: Floats, right: Floats) -> Floats:
    """Return x of Aᵀ x = b, (..., rows); the smallest where A has more rows than columns."""
    if matrix.shape[-2] == matrix.shape[-1]:
        return solve_square(matrix.swapaxes(-1, -2), right)
    return smallest(matrix, right)
