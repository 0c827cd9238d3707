"""From a branch point to the other branch that passes it."""

from collections.abc import Iterator, Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row
from jointplay.solver.continuation.doubling import DISTANCES
from jointplay.solver.continuation.multipliers import direction_of
from jointplay.solver.continuation.orbit import Orbit, Way
from jointplay.solver.continuation.settled import NoStart


def beside_branch_point(branch: Sequence[Row], number: int) -> tuple[Row, list[Way]]:
    """Return a branch point as the first orbit of the other branch, and the ways from there.

    `branch` : all orbits of the one on which it lies. `number` : of that point, from 0.

    Raises
    ------
    NoStart
        There are not so many branch points, or no orbit of another branch was found.
    """
    points = [row for row in branch if row.label == "BP"]
    if number >= len(points):
        raise NoStart(
            f"The first branch has {len(points)} branch points; try a wider range, a larger 'count'"
            " or fewer 'branch_points'."
        )
    point = points[number]
    return Row(point.orbit, 0.0, "BP", point.bounds, "start of the branch"), _switched(
        point, branch
    )


def _switched(point: Row, branch: Sequence[Row]) -> list[Way]:
    """Return orbits of the other branch on both sides of a branch point, and the ways on.

    Both branches lie in the plane of its tangent and of the direction in which the multiplier that
    is 1 stretches; orbits are sought beside the point, at right angles to the tangent. Of a
    pitchfork the other branch goes that way (Kuznetsov 2004, Elements of Applied Bifurcation
    Theory, 3rd ed., section 10.2).
    """
    across = _across(point, branch)
    found = [way for sense in (1.0, -1.0) for way in _beside(point.orbit, sense * across)]
    if not found:
        raise NoStart(
            f"No orbit of another branch was found next to the branch point at"
            f" {point.orbit.value:.9g}, down to {DISTANCES[-1]:.2g} from it; try a smaller"
            " tolerance."
        )
    return found


def _beside(orbit: Orbit, across: Floats) -> Iterator[Way]:
    """Yield the first orbit that is found in a direction, and the way on from there."""
    for distance in DISTANCES:
        found = orbit.curve.orbit(orbit.vector + distance * across, across)
        if isinstance(found, Orbit):
            yield found, across
            return


def _across(point: Row, branch: Sequence[Row]) -> Floats:
    """Return the direction, of length 1, at right angles to the branch."""
    orbit, scales = point.orbit, point.orbit.curve.scales
    along = sorted(branch, key=lambda one: one.length)
    at = next(k for k, one in enumerate(along) if one.orbit is orbit)
    beside = along[max(at - 1, 0)], along[min(at + 1, len(along) - 1)]
    tangent = beside[1].orbit.vector - beside[0].orbit.vector
    nearest = min(orbit.multipliers.real.tolist(), key=lambda one: abs(one - 1.0))
    stretched = direction_of(orbit.linear.jacobian, nearest) / scales.extents[:-1]
    across = np.append(stretched, 0.0)
    share = scales.product(across, tangent) / scales.product(tangent, tangent)
    across = across - share * tangent
    return across / scales.length(across)
