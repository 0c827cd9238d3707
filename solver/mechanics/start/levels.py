"""Equations in the order of their rights: each level gets what those above leave free.

A linear level is solved by least squares within what all levels above it leave (Siciliano and
Slotine 1991); of what is left in the end, nothing moves. Poses go by Newton's iteration on such
steps.
"""

from collections.abc import Callable, Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.linear_algebra.products import applied, length, lengths, product
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, ROUNDING, part_taken
from jointplay.solver.mechanics.start.given import Rows

MOST_ITERATIONS = 60
LESS = 0.1
"""Weight of a level against the one before, where steps are judged."""
HALVINGS = 8
"""Times that a step is halved at most, until it brings what is given nearer."""


def off(rows: Rows, step: Floats) -> Floats:
    """Return what rows are off by after a step, (rows,); after those of points, (rows, points)."""
    if step.ndim == 1:
        return rows.value + applied(rows.jacobian, step)
    value = rows.value if rows.value.ndim > 1 else rows.value[:, None]
    return value + product(rows.jacobian, step)


class Steps:
    """The smallest changes, (3 bodies,), that do for each level what they can.

    scale : (3 bodies,) what changes are measured in, m and rad.
    tolerance : a combination of rows counts as impossible below this share of the longest row.
    The first level counts to `RANK_TOLERANCE`.
    """

    def __init__(
        self, jacobians: Sequence[Floats], scale: Floats, tolerance: float = RANK_TOLERANCE
    ) -> None:
        self._scale = scale
        self._levels: list[tuple[int, Floats, Floats, Decomposition]] = []
        free = np.eye(len(scale))
        for i, jacobian in enumerate(jacobians):
            if not len(jacobian) or not free.shape[1]:
                continue
            scaled = jacobian * scale
            least = (tolerance if i else RANK_TOLERANCE) * float(lengths(scaled).max())
            left = Decomposition(product(scaled, free) if self._levels else scaled, 0.0, least)
            self._levels.append((i, scaled, free, left))
            free = product(free, left.free) if self._levels[1:] else left.free

    def step(self, values: Sequence[Floats]) -> Floats:
        """Return the change that levels off by these values want.

        values : (rows,) each, or (rows, points): then the changes are (3 bodies, points).
        """
        points = max((value.shape[1:] for value in values), key=len)
        step = np.zeros((len(self._scale), *points))
        for i, scaled, free, left in self._levels:
            wanted = left.least_squares(-off(Rows(values[i], scaled), step))
            step = step + off(Rows(np.zeros(len(free)), free), wanted)
        return np.asarray((self._scale * step.T).T)


def step_of(levels: Sequence[Rows], scale: Floats) -> Floats:
    """Return the smallest change, (3 bodies,), that does for each level what it can."""
    return Steps([rows.jacobian for rows in levels], scale).step([rows.value for rows in levels])


def approach(
    pose: Floats,
    levels: Callable[[Floats], list[Rows]],
    scale: Floats,
    judged: int,
    iterations: int = MOST_ITERATIONS,
) -> Floats:
    """Return the pose to which Newton's iteration on the levels leads from a closed one.

    judged : how many of the first levels a step must not take farther from what they want, each
    counted `LESS` than the one before; else it is halved, and the iteration ends where that does
    not help.
    """
    found = levels(pose)
    for _ in range(iterations):
        step = step_of(found, scale)
        step *= part_taken(step)
        went = _along(pose, step, levels, judged, _size(found[:judged]))
        if went is None:
            break
        step, found = went
        pose = pose + step
        if float(np.abs(step / scale).max()) < max(1e-15, ROUNDING * len(pose)):
            break
    return pose


def _along(
    pose: Floats,
    step: Floats,
    levels: Callable[[Floats], list[Rows]],
    judged: int,
    before: float,
) -> tuple[Floats, list[Rows]] | None:
    """Return that part of a step that comes nearest, and the rows there; None: none comes nearer.

    A whole step goes as far beyond what is out of reach as it was before it: half of it is tried,
    too, where the whole one gains little.
    """
    found: tuple[Floats, list[Rows]] | None = None
    least = before
    for _ in range(HALVINGS):
        rows = levels(pose + step)
        size = _size(rows[:judged])
        if found is not None and size >= least:
            break
        if size <= least:
            found, least = (step, rows), size
            if size <= 0.5 * before:
                break
        step = 0.5 * step
    return found


def _size(levels: list[Rows]) -> float:
    total = 0.0
    for rows in reversed(levels):
        total = length(rows.value) + LESS * total
    return total
