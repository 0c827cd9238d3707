"""Closing a mechanism: constraints as arrays, their rank, and Newton's iteration on a pose."""

from typing import Any

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.linear_algebra.elimination import solve
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.products import applied, lengths, product
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.quantities.scalars import SLIGHT

RANK_TOLERANCE = 1e-9
"""Columns of which less than this share of the longest is left count as zero (rows scaled by
length)."""
MOST_ITERATIONS = 200
ROUNDING = 1e-16
"""Steps, for each coordinate, below which Newton's iteration only repeats its rounding."""
DAMPING = 1e-9
"""Share of the sum of squares of all constraints' slopes, added so that none need be independent
(Levenberg 1944)."""
NEAR = 1e-4
"""Step, in rad and links, from which on `close` needs few more."""
LARGEST_TURN = 0.5
"""Largest turn of a body in one iteration, rad."""


def close(
    mechanism: AbsoluteMechanism,
    pose: Floats,
    driven: dict[str, float],
    scale: Floats,
    held: Flags | None = None,
    iterations: int = MOST_ITERATIONS,
    converged: float = 1e-15,
) -> None:
    """Move a pose to where the constraints hold, by Newton's iteration, if it gets there.

    pose : (3 bodies,) x, y (m), theta (rad). scale : (3 bodies,) what steps are measured in, m and
    rad. held : (3 bodies,) coordinates that keep their values. converged : largest step, in scales,
    after which it ends.
    """
    count, still = len(pose), [0.0] * len(pose)
    for _ in range(iterations):
        residual, jacobian = arrays(mechanism.rows(pose.tolist(), still, driven), count)
        if not len(residual) or not np.isfinite(residual).all():
            break
        if held is not None:
            jacobian[:, held] = 0.0
        step = Decomposition(jacobian * scale, RANK_TOLERANCE).least_squares(-residual)
        pose += scale * step * part_taken(step)
        if float(np.abs(step).max()) < max(converged, ROUNDING * count):
            break


def close_many(
    mechanism: AbsoluteMechanism,
    poses: Floats,
    driven: dict[str, float],
    scale: Floats,
    held: Flags,
    iterations: int,
) -> None:
    """Move many poses, (poses, 3 bodies), towards where the constraints hold, all at once.

    Where they get near, `close` does the rest; `held` coordinates, (3 bodies,), keep their values.
    """
    count = poses.shape[1]
    freed = np.where(held, 0.0, scale)
    for _ in range(iterations):
        rows = mechanism.rows(poses.T, np.zeros_like(poses.T), driven)
        residual = np.stack([np.broadcast_to(row.value, len(poses)) for row in rows], axis=1)
        jacobian = np.zeros((len(poses), len(rows), count))
        for i, row in enumerate(rows):
            for k, entry in row.jacobian.items():
                jacobian[:, i, k] = entry
        jacobian *= freed
        turned = jacobian.swapaxes(1, 2)
        square = product(jacobian, turned)
        square += (DAMPING * np.trace(square, axis1=1, axis2=2))[:, None, None] * np.eye(len(rows))
        step = applied(turned, solve(square, -residual))
        step *= part_taken(step)[:, None]
        poses += freed * step
        if np.abs(step).max() < NEAR:
            break


def part_taken(steps: Floats) -> Any:
    """Return the part of steps, (..., 3 bodies), that turns no body by more than `LARGEST_TURN`.

    A larger turn would lead to another assembly; positions follow.
    """
    turn = np.abs(steps[..., 2::3]).max(axis=-1)
    return np.minimum(1.0, LARGEST_TURN / np.maximum(turn, SLIGHT))


def arrays(rows: list[Row], count: int) -> tuple[Floats, Floats]:
    """Return residuals, (rows,), m or rad, and their Jacobian, (rows, count)."""
    jacobian = np.zeros((len(rows), count))
    for i, row in enumerate(rows):
        for k, entry in row.jacobian.items():
            jacobian[i, k] = entry
    return np.array([row.value for row in rows], np.float64), jacobian


def rank(scaled_jacobian: Floats) -> int:
    """Return the number of independent rows of a Jacobian whose columns are of one unit."""
    if not scaled_jacobian.size:
        return 0
    rows = lengths(scaled_jacobian)[:, None]
    return Decomposition(scaled_jacobian / np.maximum(rows, SLIGHT), RANK_TOLERANCE).rank
