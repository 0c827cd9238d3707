"""Curves of special orbits: where they begin, and how far their parameters are known."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit, Scales
from jointplay.solver.continuation.plan import Second
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.continuation.special_map import GRAZING, MARGIN, ROUNDING, SpecialMap
from jointplay.solver.linear_algebra.orthogonal import Decomposition
from jointplay.solver.scene.document import Scene

SAME = 0.1
"""Distance from a curve, in that of two orbits of it, within which an orbit is one of the curve."""


def starts_of_curves(
    branch: Sequence[Row],
    second: Second,
    scene_at: Callable[..., Scene],
    curves: Sequence[Sequence[Row]],
) -> Iterator[Row | NoStart]:
    """Yield special orbits of a branch as starts of curves, or why one is none.

    Without those that a curve before has passed. `scene_at` : of values of both parameters.
    `curves` : those that were followed so far; more may come between two starts.
    """
    width = second.reach.high - second.reach.low
    for row in branch:
        if row.label not in second.labels:
            continue
        try:
            orbit = special_curve(row, branch, scene_at, second.start, width)
        except NoStart as none:
            yield none
            continue
        before = [rows for rows in curves if rows and rows[0].label == row.label]
        if not any(passes(rows, orbit) for rows in before):
            yield Row(orbit, 0.0, row.label, note="start of the curve")


def special_curve(
    row: Row,
    branch: Sequence[Row],
    scene_at: Callable[..., Scene],
    second: float,
    width: float,
) -> Orbit:
    """Return a special orbit of a branch as one of the curve over a second parameter.

    `branch` : all orbits of it. `scene_at` : of values of both. `second` : its value where the
    branch is. `width` : its scale.

    Raises
    ------
    NoStart
        Newton's method does not find the orbit again.
    """
    orbit = _before_impact(row, branch) if row.label == GRAZING else row.orbit
    scales, one = orbit.curve.scales, np.ones(1)
    map_ = replace(
        orbit.curve.sections,
        scene_at=scene_at,
        second_width=width,
        watches=row.label == GRAZING,
    )
    extents = np.append(scales.extents, width)
    both = Scales(extents, np.append(scales.metric, one))
    curve = Curve(SpecialMap(map_, row.label, extents, orbit.onsets), both)
    axis = np.append(np.zeros(map_.size + 1), one)
    guess = np.append(orbit.vector, second / width)
    found = curve.orbit(guess, axis, orbit.scale)
    if isinstance(found, NoOrbit):
        raise NoStart(
            f"The special orbit {row.label} at {row.orbit.value:.9g} was not found again:"
            f" {found.reason}; try a smaller tolerance."
        )
    return found


def _before_impact(row: Row, branch: Sequence[Row]) -> Orbit:
    """Return the orbit of a branch next to grazing, on the side without the impact."""
    along = sorted(branch, key=lambda one: one.length)
    at = next(k for k, one in enumerate(along) if one.orbit is row.orbit)
    beside = [*along[max(at - 1, 0) : at], *along[at + 1 : at + 2]]
    return min((one.orbit for one in beside), key=lambda one: one.onsets)


def passes(rows: Sequence[Row], orbit: Orbit) -> bool:
    """Return whether a curve that was followed passes an orbit."""
    scales, vector = orbit.curve.scales, orbit.vector
    along = sorted(rows, key=lambda row: row.length)
    for one, other in pairwise(along):
        chord, apart = other.orbit.vector - one.orbit.vector, vector - one.orbit.vector
        length = scales.length(chord)
        share = scales.product(chord, apart) / (length * length) if length else -1.0
        if 0.0 <= share <= 1.0 and scales.length(apart - share * chord) < SAME * length:
            return True
    return False


def errors(orbit: Orbit) -> Floats:
    """Return how far both parameters of a special orbit are known.

    By what Newton's method leaves, and by what the differences of another scale would move it, at
    right angles to the curve; the error of the runs comes besides.
    """
    curve = orbit.curve
    extents = curve.scales.extents
    matrix = Decomposition(curve.bordered(orbit.linear, np.zeros(len(extents)))[:-1], ROUNDING)
    left = orbit.linear.residual
    beside = np.append(np.zeros(len(left) - 1), MARGIN * (curve.of == GRAZING))
    total = np.zeros(2)
    for away in (left, orbit.coarser.residual - left, beside):
        total += np.abs(matrix.least_squares(away / extents[:-1]))[-2:]
    return total * extents[-2:]
